#include "pipeline/search/plan.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "pipeline/search/tuning.h"

namespace polycube {
namespace {

// No CAD edge is as sharp.
constexpr double kNoEdge = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<Plan> keeping_plans(const MeshOptions& options, std::vector<LabelVariant> labels) {
  labels.resize(std::min(labels.size(), kSearchTuning.labellings));
  std::vector<Plan> list;
  const auto add = [&](const std::string& what, std::size_t first, std::size_t end, double refine, double tet_size) {
    for (std::size_t i = first; i < std::min(end, labels.size()); ++i) {
      Plan plan{.name = "all CAD edges" + what + (i > 0 ? ", labels " + std::to_string(i + 1) : ""), .refine = refine, .may_wait = true};
      plan.structure = {.labels = labels[i], .tet_size = tet_size};
      list.push_back(std::move(plan));
    }
  };
  add("", 0, kSearchTuning.best_labellings, 1, 1);
  // Where layers and circles squeeze cells into narrow corners, or fold them, circles without layers or the size alone may do.
  if (!options.coarsest && !labels.empty()) {
    add(", without layers through walls", 0, 1, 1, 1);
    list.back().layered = false;
    list.back().for_poor = true;
    add(", the size alone", 0, 1, 1, 1);
    list.back().bounded = false;
    list.back().for_poor = true;
  }
  if (!options.coarsest) add(", finer", 0, kSearchTuning.best_labellings, kSearchTuning.finer_grid, 1);
  add("", kSearchTuning.best_labellings, kSearchTuning.labellings, 1, 1);
  add(", other tets", 0, kSearchTuning.best_labellings, 1, kSearchTuning.other_tets);
  return list;
}

std::vector<Plan> last_plans() {
  return {{.name = "sharp CAD edges, no feature charts", .structure = {.min_bend = kSearchTuning.sharp_bend, .features = false}, .last = true},
          {.name = "no CAD edges", .structure = {.min_bend = kNoEdge, .features = false}, .last = true},
          {.name = "no CAD edges, other tets", .structure = {.min_bend = kNoEdge, .features = false, .tet_size = kSearchTuning.other_tets}, .last = true}};
}

}  // namespace polycube
