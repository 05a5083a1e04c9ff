#include "pipeline/search/plan.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace polycube {
namespace {

// Ways to label the part that are tried on one grid.
constexpr std::size_t kLabellings = 4;
// Those that are tried on other grids before the rest is tried on one.
constexpr std::size_t kBestLabellings = 2;
// A finer grid, on the number of cells along an edge: whether a thin strip gets one cell or two can decide over the whole mesh.
constexpr double kFinerGrid = 1.25;
// Another tet mesh gives a slightly other map, and with it other strips.
constexpr double kOtherTets = 0.8;
// Edges that bend less are left out by the plan that keeps sharp ones only.
constexpr double kSharpBend = std::numbers::pi / 18;
// No CAD edge is as sharp.
constexpr double kNoEdge = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Plan> keeping_plans(const MeshOptions& options, std::vector<LabelVariant> labels) {
  labels.resize(std::min(labels.size(), kLabellings));
  std::vector<Plan> list;
  const auto add = [&](const std::string& what, std::size_t first, std::size_t end, double refine, double tet_size) {
    for (std::size_t i = first; i < std::min(end, labels.size()); ++i) {
      Plan plan{.name = "all CAD edges" + what + (i > 0 ? ", labels " + std::to_string(i + 1) : ""), .refine = refine, .may_wait = true};
      plan.structure = {.labels = labels[i], .tet_size = tet_size};
      list.push_back(std::move(plan));
    }
  };
  add("", 0, kBestLabellings, 1, 1);
  // Where layers and circles squeeze cells into narrow corners, or fold them, the size alone may do.
  if (!options.coarsest && !labels.empty()) {
    add(", the size alone", 0, 1, 1, 1);
    list.back().bounded = false;
    list.back().for_poor = true;
  }
  if (!options.coarsest) add(", finer", 0, kBestLabellings, kFinerGrid, 1);
  add("", kBestLabellings, kLabellings, 1, 1);
  add(", other tets", 0, kBestLabellings, 1, kOtherTets);
  return list;
}

std::vector<Plan> last_plans() {
  return {{.name = "sharp CAD edges, no feature charts", .structure = {.min_bend = kSharpBend, .features = false}, .last = true},
          {.name = "no CAD edges", .structure = {.min_bend = kNoEdge, .features = false}, .last = true},
          {.name = "no CAD edges, other tets", .structure = {.min_bend = kNoEdge, .features = false, .tet_size = kOtherTets}, .last = true}};
}

}  // namespace polycube
