// Labels, maps and blocks of solids that touch, made once for all meshes of them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "blocks/blocks.h"
#include "core/error.h"
#include "core/options.h"
#include "label/features.h"
#include "pipeline/conform_labels.h"
#include "pipeline/stage_clock.h"

namespace polycube {

/// What the stages up to the blocks make of a labelling.
struct ConformalStructure {
  const TetMesh& tets;  ///< cut along the borders of the labels
  InterfaceCharts between{};
  Features features{};
  PolycuboidMap map{};
  BlockComplex blocks{};
  std::vector<int> block_solid{};
  std::vector<int> folded_faces{};  ///< CAD faces at tets that the map turns over, ascending
};

/// The structures of solids that touch, by their labellings, each made when it is first asked for. A run that was cancelled leaves them as they were.
class ConformalStructures {
 public:
  /// `options`: those of the joined solids (options_of_unit); `size` of the hexahedra in mm, by which near charts become one. Keeps references to model and
  /// tets, those of all solids. Throws InvalidInput: of labels.
  ConformalStructures(const ConformalModel& model, const TetMesh& tets, const MeshOptions& options, double size);

  /// Of attempt 0, 1 ..., as label_conformally() counts them. Throws StageFailed, the same whenever asked.
  const ConformalLabels& labels(int attempt, StageClock& clock, const Monitor& monitor);
  /// None where its labels are those of an attempt before. Throws as labels().
  const ConformalStructure* structure(int attempt, StageClock& clock, const Monitor& monitor);

  const TetMesh& tets() const { return tets_; }
  /// Per joined edge: the user does without it.
  const std::vector<char>& ignored() const { return given_.left_out; }
  /// Per joined edge: an interface ends there; its charts hold it.
  const std::vector<char>& interface_edges() const { return interface_edges_; }

 private:
  struct Attempt {
    std::optional<ConformalLabels> labels;
    bool repeats = false;
    std::unique_ptr<ConformalStructure> structure;
    std::optional<StageFailed> failure;
  };
  std::unique_ptr<ConformalStructure> built(const ConformalLabels& labels, StageClock& clock, const Monitor& monitor) const;

  const ConformalModel& model_;
  const TetMesh& tets_;
  double size_;
  int threads_;
  LabelOptions label_;
  GivenLabels given_;
  std::vector<char> interface_edges_;
  std::map<int, Attempt> attempts_;
  std::set<std::array<std::vector<int>, 2>> known_;  // labels of attempts
};

}  // namespace polycube
