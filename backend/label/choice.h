// Several labellings of one part, ranked by what can be said of them before a map is made.
#pragma once

#include <compare>
#include <list>
#include <optional>

#include "label/features.h"
#include "label/label.h"

namespace polycube {

/// What the labellings tried differ in; fields of LabelOptions.
struct LabelVariant {
  int frame = 0;           ///< one of those that the part offers
  double compactness = 1;  ///< times that of the options
  bool room = LabelOptions{}.room;
  int chamfer_axis = LabelOptions{}.chamfer_axis;
  bool facing = LabelOptions{}.facing;
  bool gradual = LabelOptions{}.gradual;
  double strictness = LabelOptions{}.strictness;
  double widest_bend = LabelOptions{}.widest_bend;
  bool narrow_regions = false;
  friend auto operator<=>(const LabelVariant&, const LabelVariant&) = default;  // NOLINT(modernize-use-nullptr)
};

/// What the search for labels begins with, for faces treated alike: where nothing is wrong with its labels, those of other ways of repair are the same.
LabelVariant plain(LabelVariant v);

struct Labelled {
  LabelVariant variant;
  TetMesh mesh;  ///< cut along the borders of its labels
  Labelling labelling;
  LabelReport report;
  double faults = 0;                ///< Violations::score
  int lost_features = 0;            ///< CAD edges without feature charts
  std::vector<int> smooth_corners;  ///< of charts, where the part is smooth (validity.h)
};

/// The labellings of one tet mesh, each made when it is first asked for.
class LabelChoice {
 public:
  /// `frames`: at least one, the best first; those of `options` do not count. `more_frames`: a bisecting_frame may join them. `left_out` as for find_features.
  /// Keeps references to model, mesh and monitor.
  LabelChoice(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, std::vector<Mat3> frames, bool more_frames, std::vector<char> left_out,
              const Monitor& monitor);

  /// All variants, those to try first in front. The first without faults ends the search: the better of it and the one that differs from it in widest_bend
  /// only comes first, then the other, then those with other frames, chamfers and compactness, then those that repair otherwise. Where each has faults, those
  /// with fewest faults and lost features come first, of equals those nearest to the normals; those with the same labels as one before come last.
  const std::vector<LabelVariant>& order();
  const Labelled& labelled(const LabelVariant& variant);
  /// One as good as the first of order(), with half of its corners or less where bent faces are smooth, in a frame along such faces: a quarter of a tube is one
  /// block along the mean normal of its bend. The map decides which is better.
  const std::optional<LabelVariant>& along_bend();
  /// What LabelVariant::frame counts; for the same variants on another mesh of the part.
  const std::vector<Mat3>& frames() const { return frames_; }
  /// Those in which no region may stand square to its label's axis: for a map that folds where some do. First those that treat bent faces as `like` does.
  std::vector<LabelVariant> facing(const LabelVariant& like) const;

 private:
  void look_along_bend();
  const CadModel& model_;
  const TetMesh& mesh_;
  LabelOptions options_;
  std::vector<Mat3> frames_;
  bool more_frames_;  // and that was not looked for yet
  std::optional<LabelVariant> along_bend_;
  std::vector<char> left_out_;
  const Monitor& monitor_;
  std::list<Labelled> made_;  // references stay valid
  std::vector<LabelVariant> order_;
};

}  // namespace polycube
