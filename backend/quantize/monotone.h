// C2: monotone paths of length 0 between different charts of one axis (paper, Definitions 4 and 5).
#pragma once

#include "quantize/problem.h"

namespace polycube {

/// One of these differences must be at least 1. Numbers of unknowns; at most one alternative per axis, by axis.
struct Cut2 {
  struct Alternative {
    int axis, low, high;
    friend auto operator<=>(const Alternative&, const Alternative&) = default;  // NOLINT(modernize-use-nullptr)
  };
  int count = 0;
  std::array<Alternative, 3> alternatives{};
  const Alternative* begin() const { return alternatives.data(); }
  const Alternative* end() const { return alternatives.data() + count; }
  friend auto operator<=>(const Cut2&, const Cut2&) = default;  // NOLINT(modernize-use-nullptr)
};

class MonotonePaths {
 public:
  MonotonePaths(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeProblem& problem, bool features);

  /// Violated constraints, sorted and distinct; finds at least one when there is any. `values`: per axis and unknown. Needs C1.
  std::vector<Cut2> violations(const std::array<const std::vector<int>*, 3>& values) const;

  /// Per block edge: axis, unknowns of its ends, block vertices of its ends, low to high.
  struct Edge {
    int axis, low, high, from, to;
    friend auto operator<=>(const Edge&, const Edge&) = default;  // NOLINT(modernize-use-nullptr)
  };
  const std::vector<Edge>& edges() const { return edges_; }
  /// Per block vertex: its unknown in each axis.
  const std::vector<std::array<int, 3>>& unknowns() const { return unknown_; }
  /// Per block vertex: bit d set where it stands on a chart (or feature) of axis d.
  const std::vector<char>& on_chart() const { return on_chart_; }

 private:
  std::vector<Edge> edges_;  ///< distinct
  std::vector<std::array<int, 3>> unknown_;
  std::vector<char> on_chart_;
  std::array<std::vector<int>, 4> order_;  ///< per octant with +u: edges so that every path meets them in turn
};

}  // namespace polycube
