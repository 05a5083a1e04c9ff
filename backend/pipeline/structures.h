// Labels, features, maps and blocks of a part, and in which order they are worth trying.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "blocks/blocks.h"
#include "core/error.h"
#include "label/choice.h"
#include "pipeline/pose.h"
#include "pipeline/realise.h"
#include "pipeline/stage_clock.h"
#include "tet/tet.h"

namespace polycube {

/// Edge length of the hexahedra to come near to, mm: that of their number where that is given.
double wanted_size(const MeshOptions& options, const CadModel& model);

/// Of the tets that labels and map are made on; `size` of the hexahedra in mm, `factor` on that of the tets.
TetOptions tet_options(double size, double diagonal, double factor = 1);

/// Charts nearer than this become one plane; `size` as for tet_options.
double merge_distance(double size, double diagonal);

/// What structures depend on: all else is at its default. Of sizes only those along axes, which leave the part one frame.
MeshOptions structural(const MeshOptions& options);

/// What the user says of the labels, in the pose.
LabelOptions label_options(const MeshOptions& options);

/// What structures differ in.
struct StructurePlan {
  LabelVariant labels{};
  double min_bend = 0;   ///< radians: CAD edges smoother than this get no feature chart
  bool features = true;  ///< feature charts at all
  double tet_size = 1;   ///< on the size of the tets
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const StructurePlan&, const StructurePlan&) = default;
};

/// What the stages up to the blocks make of a plan; shared by all that differ only afterwards.
struct Structure {
  TetMesh tets;
  Features features;
  PolycuboidMap map;
  BlockComplex blocks;
  std::optional<StageFailed> failure;
  bool repeats = false;   ///< labels and features are those of one made before: that is its failure
  int flipped = 0;        ///< tets that the map turns over
  double distortion = 0;  ///< DeformReport's
};

/// The tet meshes of one part, each made when it is first asked for. They know nothing of labels.
class TetMeshes {
 public:
  /// `size`: of the hexahedra in mm. Keeps references to the others.
  TetMeshes(const CadModel& model, double size, StageClock& clock, const Monitor& monitor);

  /// `factor` on the size of the tets. Throws StageFailed, the same whenever asked.
  const TetMesh& mesh(double factor);

 private:
  struct Made {
    TetMesh mesh;
    std::optional<StageFailed> failure;
  };
  const CadModel& model_;
  double size_;
  StageClock& clock_;
  const Monitor& monitor_;
  std::map<double, Made> made_;
};

/// The structures of one part, each made when it is first asked for.
class Structures {
 public:
  /// Keeps references to all of them; options are those of the pose, tets those of its model. A run that was cancelled leaves them as they were.
  Structures(const Pose& pose, const MeshOptions& options, TetMeshes& tets, StageClock& clock, const Monitor& monitor);

  /// Throws StageFailed, the same whenever asked; also where one made before has the same labels and features.
  const Structure& structure(const StructurePlan& plan);
  /// Ways to label the part, best first: by LabelChoice, then, where the first map fails or turns over more than a few tets, those as good by their maps; where
  /// it turns over any, and a face stands square to its label's axis, those with fewer such faces too; and one along a bend (LabelChoice) first or second, by
  /// its map. As they come where there is no tet mesh to judge them on.
  std::vector<LabelVariant> label_order();
  /// The first of LabelChoice's order, whatever its map, or one along a bend with a better one. Throws StageFailed where there is no tet mesh.
  const Labelled& labelled();
  /// Invalid labels, where others are valid, take long to map and seldom have a map.
  bool doubtful(const StructurePlan& plan);
  /// Whether one made before has the same labels and features.
  bool repeats(const StructurePlan& plan);
  /// Per CAD edge: whether the plan does without it.
  std::vector<char> left_out(const StructurePlan& plan) const;
  /// What every map of the part is made with.
  DeformOptions deform_options() const;

 private:
  LabelChoice& labellings(double tet_size);
  const Labelled& labelled(const LabelVariant& variant, double tet_size = 1);
  std::optional<LabelVariant> along_bend();
  void prefer_facing(std::vector<LabelVariant>& order);
  void sort_by_map(std::vector<LabelVariant>& order);
  /// Makes it where it is not there yet; a failure of a stage is kept in it.
  const Structure& built(const StructurePlan& plan);
  /// The map of labels without features, or what it failed by.
  struct BareMap {
    RealisedMap realised;
    std::optional<StageFailed> failure;
  };
  const BareMap& bare_map(const LabelVariant& variant, double tet_size);
  /// What a labelling is worth by its map.
  struct Rank {
    bool fails = false;
    int flipped = 0;
    double distortion = 0;
    auto operator<=>(const Rank&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  Rank rank_by_map(const LabelVariant& variant);
  /// The same with flips by their magnitude.
  std::tuple<bool, int, double> rough_rank(const LabelVariant& variant);
  bool same_labels(const LabelVariant& a, const LabelVariant& b);
  void build(const StructurePlan& plan, Structure& s, std::vector<std::vector<int>>& made);

  const Pose& pose_;
  const CadModel& model_;
  const MeshOptions& options_;
  double size_;
  std::vector<char> ignored_;
  TetMeshes& tets_;
  StageClock& clock_;
  const Monitor& monitor_;
  std::map<double, LabelChoice> labellings_;
  std::map<StructurePlan, Structure> structures_;
  std::map<std::pair<LabelVariant, double>, BareMap> bare_;
  std::set<std::vector<std::vector<int>>> tried_;  // labels and features made
};

}  // namespace polycube
