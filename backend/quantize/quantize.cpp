#include "quantize/quantize.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>

#include "core/error.h"
#include "quantize/dual_flow.h"
#include "quantize/monotone.h"
#include "quantize/problem.h"

namespace polycube {
namespace {

/// Bounds nearer than this fraction are ties: the flows' weights are rounded to 2^-50 of their sum.
constexpr double kTie = 1e-11;
/// Violated constraints whose children are solved before one is chosen to branch on.
constexpr int kCandidates = 8;

using Differences = std::array<std::vector<Difference>, 3>;

struct Node {
  int id = 0;
  double bound = 0;
  Differences extra;  ///< decided by branching, sorted
  std::array<std::shared_ptr<const AxisSolution>, 3> solution;
};

struct Worse {
  bool operator()(const std::shared_ptr<Node>& a, const std::shared_ptr<Node>& b) const {
    return a->bound != b->bound ? a->bound > b->bound : a->id > b->id;
  }
};

class Search {
 public:
  Search(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const QuantizeProblem& problem,
         const Monitor& monitor)
      : options_(options), problem_(problem), monitor_(monitor), paths_(blocks, map, problem, options.separate_features) {}

  /// Solution per axis; fills all of the result but `value`.
  std::array<std::vector<int>, 3> run(Quantization& result) {
    auto root = std::make_shared<Node>();
    for (int d = 0; d < 3; ++d) {
      root->solution[d] = std::make_shared<AxisSolution>(solve(problem_.axes[d], {}));
      if (!root->solution[d]->feasible) report_contradiction(d);
    }
    std::priority_queue<std::shared_ptr<Node>, std::vector<std::shared_ptr<Node>>, Worse> open;
    push(open, root);
    while (!open.empty()) {
      monitor_.check();
      const std::shared_ptr<Node> node = open.top();
      open.pop();
      if (!renew(*node)) continue;
      if (!open.empty() && node->bound > open.top()->bound * (1 + kTie)) {
        open.push(node);
        continue;
      }
      ++result.c2_rounds;
      const std::vector<Cut2> violated = violations(*node);
      if (violated.empty()) {
        result.cuts = static_cast<int>(seen_.size());
        result.nodes = nodes_;
        result.optimal = true;
        std::array<std::vector<int>, 3> values;
        for (int d = 0; d < 3; ++d) {
          values[d] = node->solution[d]->values;
          result.objective += node->solution[d]->objective;
        }
        result.bound = std::min(node->bound, result.objective);
        return values;
      }
      if (nodes_ > options_.node_limit) {
        throw StageFailed("quantize", "no solution within " + std::to_string(options_.node_limit) + " nodes of the search");
      }
      branch(open, *node, violated);
    }
    throw StageFailed("quantize", "the constraints leave no valid mesh: some charts would have to coincide");
  }

 private:
  using Open = std::priority_queue<std::shared_ptr<Node>, std::vector<std::shared_ptr<Node>>, Worse>;

  void push(Open& open, const std::shared_ptr<Node>& node) {
    node->id = nodes_++;
    node->bound = 0;
    for (const auto& s : node->solution) node->bound += s->bound;
    open.push(node);
  }

  std::shared_ptr<const AxisSolution> solve_axis(int d, const std::vector<Difference>& extra) const {
    std::vector<Difference> all = extra;
    all.insert(all.end(), always_[d].begin(), always_[d].end());
    auto solution = std::make_shared<AxisSolution>(solve(problem_.axes[d], all));
    return solution->feasible ? solution : nullptr;
  }

  static bool holds(const AxisSolution& solution, const Difference& difference) {
    return solution.values[difference.high] - solution.values[difference.low] >= difference.at_least;
  }

  /// Solves again where a constraint found since holds for every node; false when nothing feasible is left.
  bool renew(Node& node) const {
    node.bound = 0;
    for (int d = 0; d < 3; ++d) {
      const auto& solution = *node.solution[d];
      if (!std::all_of(always_[d].begin(), always_[d].end(), [&](const Difference& a) { return holds(solution, a); })) {
        node.solution[d] = solve_axis(d, node.extra[d]);
        if (!node.solution[d]) return false;
      }
      node.bound += node.solution[d]->bound;
    }
    return true;
  }

  std::vector<Cut2> violations(const Node& node) {
    auto found = paths_.violations({&node.solution[0]->values, &node.solution[1]->values, &node.solution[2]->values});
    for (const Cut2& cut : found) {
      const auto at = std::lower_bound(seen_.begin(), seen_.end(), cut);
      if (at == seen_.end() || *at != cut) seen_.insert(at, cut);
    }
    return found;
  }

  void branch(Open& open, const Node& node, const std::vector<Cut2>& violated) {
    // One alternative only: no choice, and true in the whole tree.
    bool forced = false;
    for (const Cut2& cut : violated) {
      if (cut.alternatives.size() > 1) continue;
      const auto& a = cut.alternatives.front();
      always_[a.axis].push_back({a.low, a.high, 1});
      forced = true;
    }
    if (forced) {
      auto again = std::make_shared<Node>(node);
      if (renew(*again)) push(open, again);
      return;
    }
    // Of the first few the one whose children have the highest bounds: the cheapest child decides.
    std::vector<std::shared_ptr<Node>> best;
    double best_bound = -1;
    const std::size_t count = std::min<std::size_t>(violated.size(), kCandidates);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::shared_ptr<Node>> children = split(node, violated[i * violated.size() / count]);
      double least = std::numeric_limits<double>::infinity();
      for (const auto& child : children) {
        double bound = 0;
        for (const auto& s : child->solution) bound += s->bound;
        least = std::min(least, bound);
      }
      if (least > best_bound) {
        best_bound = least;
        best = std::move(children);
      }
    }
    for (const auto& child : best) push(open, child);
  }

  /// Children that share no solution: the k-th has the k-th difference at least 1 and the ones before it at most 0.
  std::vector<std::shared_ptr<Node>> split(const Node& node, const Cut2& cut) const {
    std::vector<std::shared_ptr<Node>> children;
    for (std::size_t k = 0; k < cut.alternatives.size(); ++k) {
      auto child = std::make_shared<Node>(node);
      bool feasible = true;
      for (std::size_t j = 0; j <= k && feasible; ++j) {
        const auto& a = cut.alternatives[j];
        auto& extra = child->extra[a.axis];
        extra.push_back(j == k ? Difference{a.low, a.high, 1} : Difference{a.high, a.low, 0});
        if (holds(*child->solution[a.axis], extra.back())) continue;
        child->solution[a.axis] = solve_axis(a.axis, extra);
        feasible = child->solution[a.axis] != nullptr;
      }
      if (feasible) children.push_back(std::move(child));
    }
    return children;
  }

  [[noreturn]] void report_contradiction(int axis) const {
    std::string names;
    for (const Difference& d : contradiction(problem_.axes[axis], {})) {
      if (d.source < 0) continue;
      const std::string name = "'" + options_.constraints[d.source].name + "'";
      if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    }
    if (names.empty()) throw StageFailed("quantize", "the order of the charts contradicts itself");
    throw InvalidInput("constraints that cannot hold together: " + names);
  }

  const QuantizeOptions& options_;
  const QuantizeProblem& problem_;
  const Monitor& monitor_;
  MonotonePaths paths_;
  Differences always_;      ///< C2 constraints with one alternative
  std::vector<Cut2> seen_;  ///< sorted
  int nodes_ = 0;
};

}  // namespace

Quantization quantize(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const Monitor& monitor) {
  monitor.progress("quantize", 0);
  const QuantizeProblem problem = build_problem(blocks, map, options);
  Quantization result;
  const auto values = Search(blocks, map, options, problem, monitor).run(result);
  result.value.resize(map.charts.size());
  for (std::size_t c = 0; c < map.charts.size(); ++c) {
    const Chart& chart = map.charts[c];
    int number = problem.number[c];
    if (number < 0) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int k = 0; k < static_cast<int>(problem.axes[chart.axis].charts.size()); ++k) {
        const double distance = std::abs(map.charts[problem.axes[chart.axis].charts[k]].value - chart.value);
        if (distance >= nearest) continue;
        nearest = distance;
        number = k;
      }
    }
    result.value[c] = values[chart.axis][number];
  }
  monitor.progress("quantize", 1);
  return result;
}

QuantizeReport check(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const std::vector<int>& value) {
  QuantizeReport report;
  const QuantizeProblem problem = build_problem(blocks, map, options);
  std::array<std::vector<int>, 3> values;
  for (int d = 0; d < 3; ++d) {
    for (int c : problem.axes[d].charts) values[d].push_back(value[c]);
    report.objective += objective(problem.axes[d], values[d]);
  }
  for (const Block& block : blocks.blocks) {
    for (const auto& [low, high] : block.charts) report.c1 += value[high] < value[low];
  }
  for (const auto& [d, low, high] : opposite_charts(blocks)) report.opposite += value[high] - value[low] < options.min_layers;
  for (const DistanceConstraint& c : options.constraints) {
    const int distance = value[c.high] - value[c.low];
    report.constraints += distance < c.at_least || distance > c.at_most;
  }
  if (report.c1 == 0) {
    const MonotonePaths paths(blocks, map, problem, options.separate_features);
    report.c2 = static_cast<int>(paths.violations({&values[0], &values[1], &values[2]}).size());
  }
  return report;
}

}  // namespace polycube
