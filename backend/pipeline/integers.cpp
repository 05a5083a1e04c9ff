#include "pipeline/integers.h"

#include <cmath>

#include "pipeline/bounds.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

// `bounds` get those of neighbouring cells added.
Quantization at_scale(const BlockComplex& blocks, const PolycuboidMap& map, const IntegerOptions& options, double scale,
                      std::vector<DistanceConstraint>& bounds, const Monitor& monitor) {
  QuantizeOptions asked = options.demanded(scale);
  const auto add = [&](const std::vector<DistanceConstraint>& more) { asked.constraints.insert(asked.constraints.end(), more.begin(), more.end()); };
  add(options.room);
  add(bounds);
  Quantization result = quantize(blocks, map, asked, monitor);
  for (int round = 0; round < kPipelineTuning.neighbour_rounds && options.growing && !options.coarsest; ++round) {
    const std::vector<DistanceConstraint> more = neighbour_bounds(map, blocks, result.value, options.growth, 1 / scale, options.local);
    if (more.empty()) break;
    add(more);
    bounds.insert(bounds.end(), more.begin(), more.end());
    result = quantize(blocks, map, asked, monitor);
  }
  return result;
}

}  // namespace

double cell_count(const BlockComplex& blocks, const std::vector<int>& value) {
  double cells = 0;
  for (const Block& b : blocks.blocks) {
    double product = 1;
    for (const auto& [low, high] : b.charts) product *= value[high] - value[low];
    cells += product;
  }
  return cells;
}

Integers find_integers(const BlockComplex& blocks, const PolycuboidMap& map, const IntegerOptions& options, const Monitor& monitor) {
  double scale = options.scale;
  std::vector<DistanceConstraint> bounds = options.bounds;
  Quantization result = at_scale(blocks, map, options, scale, bounds, monitor);
  if (options.wanted_cells > 0) {
    const auto miss = [&](const Quantization& q) { return std::abs(std::log(cell_count(blocks, q.value) / options.wanted_cells)); };
    // Between two scales that give fewer and more: the next by how the number goes with the scale, or the middle once both are known.
    double tried = scale, low = 0, high = 0;
    double best = miss(result);
    Quantization next = result;
    for (int round = 0; round < kPipelineTuning.count_rounds && best > kPipelineTuning.count_miss; ++round) {
      const double cells = cell_count(blocks, next.value);
      (cells < options.wanted_cells ? low : high) = tried;
      tried = low > 0 && high > 0 ? std::sqrt(low * high) : tried * std::pow(options.wanted_cells / cells, kPipelineTuning.count_power);
      if (tried < scale / kPipelineTuning.count_reach || tried > scale * kPipelineTuning.count_reach) break;
      std::vector<DistanceConstraint> asked = options.bounds;
      next = at_scale(blocks, map, options, tried, asked, monitor);
      if (miss(next) >= best) continue;
      best = miss(next);
      result = next;
      bounds = std::move(asked);
    }
    scale = tried;
  }
  return {result, deciding(bounds, map, result.value, scale)};
}

}  // namespace polycube
