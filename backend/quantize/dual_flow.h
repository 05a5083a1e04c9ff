// Convex costs on differences of integers, solved exactly as the dual of a minimum-cost flow.
#pragma once

#include "quantize/problem.h"

namespace polycube {

struct AxisSolution {
  bool feasible = false;
  std::vector<int> values;  ///< per unknown, smallest 0
  double objective = 0;
  double bound = 0;  ///< value of the dual flow: no integers have a smaller objective (up to rounding of the weights, 2^-50 of their sum)
};

/// Minimises the terms under the problem's differences and `extra` ones.
AxisSolution solve(const AxisProblem& problem, const std::vector<Difference>& extra);

/// Differences that cannot hold together: a cycle with positive sum. Empty when they can.
std::vector<Difference> contradiction(const AxisProblem& problem, const std::vector<Difference>& extra);

}  // namespace polycube
