// The quantization of a block complex as three problems on differences, coupled by C2 only.
#pragma once

#include "quantize/quantize.h"

namespace polycube {

/// weight * |l[high] - l[low] - target|
struct Term {
  int low, high;
  double weight, target;
};

/// l[high] - l[low] >= at_least
struct Difference {
  int low, high;
  int at_least;
  static constexpr int kNone = -1, kLayers = -2, kStructure = -3;
  int source = kNone;  ///< engineer's constraint it comes from; kLayers: QuantizeOptions::min_layers above 1;
                       ///< kStructure: QuantizeOptions::structure
  friend bool operator==(const Difference&, const Difference&) = default;
  friend auto operator<=>(const Difference&, const Difference&) = default;  // NOLINT(modernize-use-nullptr)
};

/// One axis; low and high are numbers of unknowns of this axis.
struct AxisProblem {
  std::vector<int> charts;              ///< per unknown: its chart (BlockComplex::unknown)
  std::vector<Term> terms;              ///< sorted, one per (low, high, target)
  std::vector<Difference> differences;  ///< sorted, one per (low, high): C1, opposite charts, engineer's
};

struct QuantizeProblem {
  std::array<AxisProblem, 3> axes;
  std::vector<int> number;  ///< per chart: its unknown's number in its axis, -1 without sheet
};

/// Throws InvalidInput on constraints between charts that have no common axis, on options out of bounds and on far too many cells.
QuantizeProblem build_problem(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options);

/// Charts that bound a line of blocks on both ends, with the axis; chart numbers as in BlockComplex::unknown. Sorted, distinct.
std::vector<std::array<int, 3>> opposite_charts(const BlockComplex& blocks);

double objective(const AxisProblem& problem, const std::vector<int>& values);

}  // namespace polycube
