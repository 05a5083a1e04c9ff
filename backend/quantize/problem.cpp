#include "quantize/problem.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/options.h"

namespace polycube {

std::vector<std::array<int, 3>> opposite_charts(const BlockComplex& complex) {
  std::vector<std::array<int, 3>> pairs;
  for (const Block& first : complex.blocks) {
    for (int d = 0; d < 3; ++d) {
      if (first.neighbours[low_side(d)] >= 0) continue;
      const Block* last = &first;
      while (last->neighbours[2 * d + 1] >= 0) last = &complex.blocks[last->neighbours[2 * d + 1]];
      pairs.push_back({d, first.charts[d][0], last->charts[d][1]});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

QuantizeProblem build_problem(const BlockComplex& complex, const PolycuboidMap& map, const QuantizeOptions& options) {
  if (!(options.scale >= 0) || !std::isfinite(options.scale)) throw InvalidInput("the scale of the quantization must be 0 or more");
  if (!options.block_scale.empty() && options.block_scale.size() != complex.blocks.size()) {
    throw InvalidInput("the block scales are not one per block");
  }
  double cells = 0;
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    double share = complex.blocks[b].volume;
    for (double factor : options.axis_scale) share *= factor * options.scale * (options.block_scale.empty() ? 1.0 : options.block_scale[b]);
    cells += share;
  }
  check_count(cells);
  QuantizeProblem problem;
  const int chart_count = static_cast<int>(map.charts.size());
  problem.number.assign(chart_count, -1);
  for (int c = 0; c < chart_count; ++c) {
    const int unknown = complex.unknown[c];
    if (unknown < 0) continue;
    if (problem.number[unknown] < 0) {
      auto& charts = problem.axes[map.charts[c].axis].charts;
      problem.number[unknown] = static_cast<int>(charts.size());
      charts.push_back(unknown);
    }
    problem.number[c] = problem.number[unknown];
  }
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    const Block& block = complex.blocks[b];
    const double scale = options.scale * (options.block_scale.empty() ? 1.0 : options.block_scale[b]);
    for (int d = 0; d < 3; ++d) {
      const auto [low, high] = block.charts[d];
      const double distance = map.charts[high].value - map.charts[low].value;
      problem.axes[d].terms.push_back({problem.number[low], problem.number[high], block.volume / distance, scale * options.axis_scale[d] * distance});
      problem.axes[d].differences.push_back({problem.number[low], problem.number[high], 0});
    }
  }
  if (!options.structure.empty()) {
    if (options.structure.size() != map.charts.size()) throw InvalidInput("the structure does not have one integer per chart");
    for (const Block& block : complex.blocks) {
      for (int d = 0; d < 3; ++d) {
        const auto [low, high] = block.charts[d];
        const int extent = options.structure[high] - options.structure[low];
        if (extent < 0) throw InvalidInput("the structure is not in the order of the map");
        problem.axes[d].differences.push_back({problem.number[low], problem.number[high], extent, Difference::kStructure});
        if (extent == 0) problem.axes[d].differences.push_back({problem.number[high], problem.number[low], 0, Difference::kStructure});
      }
    }
  }
  for (const auto& [d, low, high] : opposite_charts(complex)) {
    problem.axes[d].differences.push_back(
        {problem.number[low], problem.number[high], options.min_layers, options.min_layers > 1 ? Difference::kLayers : Difference::kNone});
  }
  for (int i = 0; i < static_cast<int>(options.constraints.size()); ++i) {
    const DistanceConstraint& c = options.constraints[i];
    if (c.low < 0 || c.high < 0 || c.low >= chart_count || c.high >= chart_count || map.charts[c.low].axis != map.charts[c.high].axis) {
      throw InvalidInput("constraint '" + c.name + "' is not between two charts of one axis");
    }
    const int low = problem.number[c.low], high = problem.number[c.high];
    if (low < 0 || high < 0) throw InvalidInput("constraint '" + c.name + "' is on a feature that no sheet reaches");
    auto& differences = problem.axes[map.charts[c.low].axis].differences;
    if (c.at_least != std::numeric_limits<int>::min()) differences.push_back({low, high, c.at_least, i});
    if (c.at_most != std::numeric_limits<int>::max()) differences.push_back({high, low, -c.at_most, i});
  }
  for (AxisProblem& axis : problem.axes) {
    const auto key = [](const Term& t) { return std::tuple(t.low, t.high, t.target); };
    std::stable_sort(axis.terms.begin(), axis.terms.end(), [&](const Term& a, const Term& b) { return key(a) < key(b); });
    std::size_t kept = 0;
    for (const Term& t : axis.terms) {
      if (kept > 0 && key(axis.terms[kept - 1]) == key(t)) {
        axis.terms[kept - 1].weight += t.weight;
      } else {
        axis.terms[kept++] = t;
      }
    }
    axis.terms.resize(kept);
    // Of differences between the same two the strongest says all.
    std::sort(axis.differences.begin(), axis.differences.end(), [](const Difference& a, const Difference& b) {
      return std::tuple(a.low, a.high, -a.at_least, a.source) < std::tuple(b.low, b.high, -b.at_least, b.source);
    });
    const auto end = std::unique(axis.differences.begin(), axis.differences.end(),
                                 [](const Difference& a, const Difference& b) { return a.low == b.low && a.high == b.high; });
    axis.differences.erase(end, axis.differences.end());
  }
  return problem;
}

double objective(const AxisProblem& problem, const std::vector<int>& values) {
  double sum = 0;
  for (const Term& t : problem.terms) sum += t.weight * std::abs(values[t.high] - values[t.low] - t.target);
  return sum;
}

}  // namespace polycube
