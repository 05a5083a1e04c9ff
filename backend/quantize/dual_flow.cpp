#include "quantize/dual_flow.h"

#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <cmath>

namespace polycube {
namespace {

using Int = long long;

/// Sum of all weights after scaling to integers. Flows stay below it, and flow times cost is never formed.
constexpr double kWeightSum = 1125899906842624.0;  // 2^50

/// |x - target| between the integers around the target is replaced by its chord: equal at integers, and breakpoints become integers.
struct Breakpoint {
  int at;
  Int jump;  ///< of the slope
};

}  // namespace

AxisSolution solve(const AxisProblem& problem, const std::vector<Difference>& extra) {
  const int n = static_cast<int>(problem.charts.size());
  AxisSolution solution;
  double weight_sum = 0;
  for (const Term& t : problem.terms) weight_sum += t.weight;
  const double to_integer = weight_sum > 0 ? kWeightSum / weight_sum : 0;

  // A difference x = l[high] - l[low] with convex piecewise linear cost is a flow on low -> high: slopes are flow, breakpoints cost.
  lemon::SmartDigraph graph;
  graph.reserveNode(n);
  std::vector<Int> capacity, cost;
  for (int i = 0; i < n; ++i) graph.addNode();
  const auto add_arc = [&](int from, int to, Int arc_capacity, Int arc_cost) {
    graph.addArc(graph.nodeFromId(from), graph.nodeFromId(to));
    capacity.push_back(arc_capacity);
    cost.push_back(arc_cost);
  };
  Int total = 0;
  double at_best = 0;  // the terms' sum if every difference could take its own best value
  std::vector<Breakpoint> breakpoints;
  for (std::size_t i = 0; i < problem.terms.size();) {
    const int low = problem.terms[i].low, high = problem.terms[i].high;
    const std::size_t begin = i;
    breakpoints.clear();
    Int slope = 0;
    for (; i < problem.terms.size() && problem.terms[i].low == low && problem.terms[i].high == high; ++i) {
      const Term& t = problem.terms[i];
      const Int weight = std::llround(t.weight * to_integer);
      const double below = std::floor(t.target);
      const Int first = std::clamp<Int>(std::llround(2.0 * static_cast<double>(weight) * (below + 1 - t.target)), 0, 2 * weight);
      if (first > 0) breakpoints.push_back({static_cast<int>(below), first});
      if (first < 2 * weight) breakpoints.push_back({static_cast<int>(below) + 1, 2 * weight - first});
      slope -= weight;
    }
    std::stable_sort(breakpoints.begin(), breakpoints.end(), [](const Breakpoint& a, const Breakpoint& b) { return a.at < b.at; });
    for (const Breakpoint& b : breakpoints) {
      // The part of the jump below slope 0 is flow against the arc, the part above flow along it.
      const Int down = std::clamp<Int>(-slope, 0, b.jump), up = b.jump - down;
      if (down > 0) add_arc(high, low, down, -static_cast<Int>(b.at));
      if (up > 0) add_arc(low, high, up, b.at);
      if (slope < 0 && slope + b.jump >= 0) {
        for (std::size_t k = begin; k < i; ++k) at_best += problem.terms[k].weight * std::abs(b.at - problem.terms[k].target);
      }
      slope += b.jump;
      total += b.jump;
    }
  }
  // Without a contradiction every cycle of the optimal flow has an arc of a term, so this capacity is never used up.
  const Int unlimited = total + 1;
  const auto add_difference = [&](const Difference& d) { add_arc(d.high, d.low, unlimited, -static_cast<Int>(d.at_least)); };
  for (const Difference& d : problem.differences) add_difference(d);
  for (const Difference& d : extra) add_difference(d);

  lemon::SmartDigraph::ArcMap<Int> upper(graph), costs(graph);
  for (int a = 0; a < graph.arcNum(); ++a) {
    upper[graph.arcFromId(a)] = capacity[a];
    costs[graph.arcFromId(a)] = cost[a];
  }
  lemon::NetworkSimplex<lemon::SmartDigraph, Int, Int> simplex(graph);
  simplex.upperMap(upper).costMap(costs);
  simplex.run();
  solution.values.resize(n);
  for (int i = 0; i < n; ++i) solution.values[i] = static_cast<int>(simplex.potential(graph.nodeFromId(i)));
  const auto holds = [&](const Difference& d) { return solution.values[d.high] - solution.values[d.low] >= d.at_least; };
  solution.feasible =
      std::all_of(problem.differences.begin(), problem.differences.end(), holds) && std::all_of(extra.begin(), extra.end(), holds);
  if (!solution.feasible) return solution;
  const int smallest = n > 0 ? *std::min_element(solution.values.begin(), solution.values.end()) : 0;
  for (int& v : solution.values) v -= smallest;
  solution.objective = objective(problem, solution.values);
  double saved = 0;
  for (int a = 0; a < graph.arcNum(); ++a) {
    saved -= static_cast<double>(simplex.flow(graph.arcFromId(a))) * static_cast<double>(cost[a]);
  }
  solution.bound = at_best + (to_integer > 0 ? saved / to_integer : 0);
  return solution;
}

std::vector<Difference> contradiction(const AxisProblem& problem, const std::vector<Difference>& extra) {
  const int n = static_cast<int>(problem.charts.size());
  std::vector<Difference> all = problem.differences;
  all.insert(all.end(), extra.begin(), extra.end());
  std::vector<long long> distance(n, 0);
  std::vector<int> by(n, -1);
  int changed = -1;
  for (int round = 0; round <= n; ++round) {
    changed = -1;
    for (int i = 0; i < static_cast<int>(all.size()); ++i) {
      const Difference& d = all[i];
      if (distance[d.low] + d.at_least <= distance[d.high]) continue;
      distance[d.high] = distance[d.low] + d.at_least;
      by[d.high] = i;
      changed = d.high;
    }
    if (changed < 0) return {};
  }
  for (int i = 0; i < n; ++i) changed = all[by[changed]].low;
  std::vector<Difference> cycle;
  int at = changed;
  do {
    cycle.push_back(all[by[at]]);
    at = all[by[at]].low;
  } while (at != changed);
  return cycle;
}

}  // namespace polycube
