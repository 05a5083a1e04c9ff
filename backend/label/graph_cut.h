// Multi-label graph cut: alpha expansion (Boykov, Veksler, Zabih 2001) over Boost.Graph's Boykov-Kolmogorov max flow.
#pragma once

#include <array>
#include <vector>

#include "core/monitor.h"

namespace polycube {

inline constexpr double kForbidden = 1e9;

struct CutProblem {
  std::vector<std::array<double, 6>> data;  ///< cost of each label per node; >= kForbidden forbids it
  struct Link {
    int a, b;
    double weight;  ///< cost when the labels differ; twice that for opposite labels of one axis
  };
  std::vector<Link> links;
};

/// Labels of low energy, starting from each node's cheapest label. The result depends on nothing but the problem.
std::vector<int> solve(const CutProblem& problem, const Monitor& monitor);

double energy(const CutProblem& problem, const std::vector<int>& labels);

}  // namespace polycube
