// Ways through the stages, as values.
#pragma once

#include <string>
#include <vector>

#include "core/options.h"
#include "pipeline/structures.h"

namespace polycube {

/// Which CAD edges a plan gives up where the cells of an earlier one stayed inverted.
enum class Surrender {
  kNothing,  ///< it starts anew
  kEdges,    ///< those that most inverted cells stand on, smooth ones first, more and more of them
  kAround,   ///< all edges within more and more cells of the inverted ones
};

struct Plan {
  std::string name;           ///< for the log
  StructurePlan structure{};  ///< CAD edges that it does without get no path either
  double refine = 1;          ///< on the number of cells along an edge
  bool bounded = true;        ///< with the counts that the part itself asks for (bounds.h), but those that options name
  bool layered = true;        ///< and of those the layers through walls
  bool for_poor = false;      ///< it is left out where there is a complete mesh whose cells are not poor
  bool may_wait = false;      ///< where its labels are doubtful it is tried after those whose labels are not
  Surrender surrender = Surrender::kNothing;
  int of = -1;        ///< of a surrender: the attempt whose mesh it starts from
  bool last = false;  ///< better than nothing, with fits of its own
};

/// Plans that keep every CAD edge: the two best labellings as asked for, on a finer grid, the next two, other tets. `labels`: the ways to label the part, best
/// first.
std::vector<Plan> keeping_plans(const MeshOptions& options, std::vector<LabelVariant> labels);

/// Without feature charts, without CAD edges: for a look at volumes and modes.
std::vector<Plan> last_plans();

}  // namespace polycube
