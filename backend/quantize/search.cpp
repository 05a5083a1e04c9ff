#include "quantize/search.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "quantize/tuning.h"

namespace polycube {
namespace {

/// All weights together after scaling to integers. Flows stay below twice it.
constexpr double kWeightSum = 1125899906842624.0;  // 2^50

std::array<const std::vector<int>*, 3> values_of(const std::array<AxisFlow, 3>& flows) { return {&flows[0].values(), &flows[1].values(), &flows[2].values()}; }

}  // namespace

Search::Search(const QuantizeProblem& problem, const MonotonePaths& paths, int node_limit, const Monitor& monitor)
    : problem_(problem), paths_(paths), node_limit_(node_limit), monitor_(monitor) {
  double weights = 0, scale = 0;
  for (const AxisProblem& axis : problem.axes) {
    for (const Term& t : axis.terms) {
      weights += t.weight;
      scale += t.weight * (1 + std::abs(t.target));
    }
  }
  to_integer_ = weights > 0 ? kWeightSum / weights : 1;
  tie_ = kQuantizeTuning.tie * scale;
  networks_.reserve(3);
  for (const AxisProblem& axis : problem.axes) networks_.emplace_back(axis, to_integer_);
}

Search::Outcome Search::run(Quantization& result) {
  Outcome outcome;
  auto root = std::make_shared<Node>();
  for (int d = 0; d < 3; ++d) {
    root->flows[d] = solve_axis(d, {});
    if (root->flows[d]) continue;
    outcome.infeasible_axis = d;
    return outcome;
  }
  root->bound = bound_of(*root);
  std::priority_queue<NodePtr, std::vector<NodePtr>, Later> open;
  const auto push = [&](const NodePtr& node) {
    node->id = nodes_++;
    open.push(node);
  };
  push(root);
  double bound = std::numeric_limits<double>::infinity();
  while (!open.empty()) {
    monitor_.check();
    const NodePtr node = open.top();
    if (node->bound >= best_objective_ - tie_ || nodes_ >= node_limit_) {
      bound = node->bound;
      break;
    }
    open.pop();
    for (const NodePtr& next : expand(node)) {
      if (next == node) {
        open.push(node);
      } else {
        push(next);
      }
    }
  }
  // Out of nodes: the first solution that can be had, depth first.
  while (!open.empty() && best_objective_ == std::numeric_limits<double>::infinity()) {
    std::vector<NodePtr> stack{open.top()};
    open.pop();
    while (!stack.empty() && best_objective_ == std::numeric_limits<double>::infinity()) {
      monitor_.check();
      const NodePtr node = stack.back();
      stack.pop_back();
      auto next = expand(node);
      std::stable_sort(next.begin(), next.end(), [](const NodePtr& a, const NodePtr& b) { return a->bound > b->bound; });
      for (const NodePtr& n : next) nodes_ += n != node;
      stack.insert(stack.end(), next.begin(), next.end());
    }
  }
  result.c2_rounds = rounds_;
  result.cuts = static_cast<int>(seen_.size());
  result.nodes = nodes_;
  result.flows_solved = solved_;
  result.flows_repaired = repaired_;
  if (best_objective_ == std::numeric_limits<double>::infinity()) return outcome;
  outcome.found = true;
  outcome.values = best_;
  result.objective = best_objective_;
  result.bound = std::min(bound, best_objective_);
  result.optimal = bound >= best_objective_ - tie_;
  return outcome;
}

double Search::bound_of(const Node& node) { return node.flows[0]->bound() + node.flows[1]->bound() + node.flows[2]->bound(); }

std::shared_ptr<const AxisFlow> Search::solve_axis(int axis, const std::vector<Difference>& extra) {
  ++solved_;
  std::optional<AxisFlow> flow = networks_[axis].solve(extra);
  return flow ? std::make_shared<const AxisFlow>(std::move(*flow)) : nullptr;
}

std::vector<Cut2> Search::violations(const std::array<const std::vector<int>*, 3>& values) {
  ++rounds_;
  auto found = paths_.violations(values);
  std::vector<Cut2> all;
  all.reserve(seen_.size() + found.size());
  std::set_union(seen_.begin(), seen_.end(), found.begin(), found.end(), std::back_inserter(all));
  seen_ = std::move(all);
  return found;
}

void Search::offer(const std::array<const std::vector<int>*, 3>& values) {
  double sum = 0;
  for (int d = 0; d < 3; ++d) sum += objective(problem_.axes[d], *values[d]);
  if (sum >= best_objective_) return;
  best_objective_ = sum;
  for (int d = 0; d < 3; ++d) best_[d] = *values[d];
}

/// One alternative only: no choice, and true in the whole tree.
bool Search::keep_forced(const std::vector<Cut2>& violated) {
  bool any = false;
  for (const Cut2& cut : violated) {
    if (cut.count > 1) continue;
    const auto& a = cut.alternatives[0];
    always_[a.axis].push_back({a.low, a.high, 1});
    any = true;
  }
  if (!any) return false;
  for (auto& differences : always_) {
    std::sort(differences.begin(), differences.end());
    differences.erase(std::unique(differences.begin(), differences.end()), differences.end());
  }
  return true;
}

/// Repairs the flows where a constraint that holds for every node was found since; false when nothing feasible is left.
bool Search::renew(Node& node) {
  for (int d = 0; d < 3; ++d) {
    for (;;) {
      std::vector<Difference> missing;
      for (const Difference& a : always_[d]) {
        if (!node.flows[d]->holds(a)) missing.push_back(a);
      }
      if (missing.empty()) break;
      if (missing.size() > kQuantizeTuning.repairs) {
        std::vector<Difference> extra = node.decided[d];
        extra.insert(extra.end(), always_[d].begin(), always_[d].end());
        node.flows[d] = solve_axis(d, extra);
        if (!node.flows[d]) return false;
      } else {
        ++repaired_;
        auto flow = std::make_shared<AxisFlow>(*node.flows[d]);
        for (const Difference& a : missing) {
          if (!flow->demand(a)) return false;
        }
        node.flows[d] = flow;
      }
    }
  }
  node.bound = std::max(node.bound, bound_of(node));
  return true;
}

std::vector<Search::NodePtr> Search::expand(const NodePtr& node) {
  const double before = node->bound;
  if (!renew(*node)) return {};
  if (node->bound > before + tie_) return {node};
  const auto& flows = node->flows;
  const std::array<const std::vector<int>*, 3> values{&flows[0]->values(), &flows[1]->values(), &flows[2]->values()};
  const std::vector<Cut2> violated = violations(values);
  if (violated.empty()) {
    offer(values);
    return {};
  }
  if (keep_forced(violated)) return {node};
  if (!node->raised) {
    node->raised = true;
    if (!raise(*node, violated)) return {};
    return {node};
  }
  return branch(*node, violated);
}

/// A better bound than the flows', for constraints that are still open. Every alternative of a violated one is given the same reward m for
/// holding: of k alternatives a solution must hold one, so the optimum with rewards is at most (k - 1) m above the optimum. Constraints
/// that have nothing to do with each other add up, and the potentials that come out are often a solution that meets the bound.
bool Search::raise(Node& node, std::vector<Cut2> violated) {
  std::array<AxisFlow, 3> flows{*node.flows[0], *node.flows[1], *node.flows[2]};
  repaired_ += 3;
  FlowInt surplus = 0;
  double bound = node.bound;
  int idle = 0;
  for (int round = 0; round < kQuantizeTuning.reward_rounds && idle < kQuantizeTuning.idle_rounds; ++round) {
    monitor_.check();
    for (const Cut2& cut : violated) {
      const auto met = [&](const Cut2::Alternative& a) { return flows[a.axis].span(a.low, a.high) > 0; };
      if (std::any_of(cut.begin(), cut.end(), met)) continue;
      if (cut.count == 1) {
        const auto& a = cut.alternatives[0];
        if (!flows[a.axis].demand({a.low, a.high, 1})) return false;
        continue;
      }
      FlowInt least = AxisFlow::kUnlimited;
      const Cut2::Alternative* cheapest = nullptr;
      for (const auto& a : cut) {
        const FlowInt pushed = flows[a.axis].push(a.low, a.high, least);
        if (pushed >= least) continue;
        least = pushed;
        cheapest = &a;
      }
      if (cheapest == nullptr) return false;
      for (const auto& a : cut) flows[a.axis].settle(a.low, a.high, least);
      surplus += (cut.count - 1) * least;
      flows[cheapest->axis].follow(cheapest->low, cheapest->high);
    }
    const double now = flows[0].bound() + flows[1].bound() + flows[2].bound() - static_cast<double>(surplus) / to_integer_;
    idle = now > bound + tie_ ? 0 : idle + 1;
    bound = std::max(bound, now);
    violated = violations(values_of(flows));
    if (violated.empty()) {
      offer(values_of(flows));
      break;
    }
    keep_forced(violated);
  }
  node.bound = bound;
  return true;
}

std::vector<Search::NodePtr> Search::branch(const Node& node, const std::vector<Cut2>& violated) {
  // Of the first few the one whose children have the highest bounds: the cheapest child decides.
  std::vector<NodePtr> best;
  double best_bound = -1;
  const std::size_t count = std::min<std::size_t>(violated.size(), kQuantizeTuning.candidates);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<NodePtr> children = split(node, violated[i * violated.size() / count]);
    double least = std::numeric_limits<double>::infinity();
    for (const auto& child : children) least = std::min(least, bound_of(*child));
    if (least > best_bound) {
      best_bound = least;
      best = std::move(children);
    }
  }
  for (const auto& child : best) child->bound = std::max(node.bound, bound_of(*child));
  return best;
}

/// Children that share no solution: the k-th has the k-th difference at least 1 and the ones before it at most 0.
std::vector<Search::NodePtr> Search::split(const Node& node, const Cut2& cut) {
  std::vector<NodePtr> children;
  for (int k = 0; k < cut.count; ++k) {
    auto child = std::make_shared<Node>(node);
    child->raised = false;
    bool feasible = true;
    for (int j = 0; j <= k && feasible; ++j) {
      const auto& a = cut.alternatives[j];
      const Difference decision = j == k ? Difference{a.low, a.high, 1} : Difference{a.high, a.low, 0};
      child->decided[a.axis].push_back(decision);
      ++repaired_;
      auto flow = std::make_shared<AxisFlow>(*child->flows[a.axis]);
      feasible = flow->demand(decision);
      child->flows[a.axis] = flow;
    }
    if (feasible) children.push_back(std::move(child));
  }
  return children;
}

}  // namespace polycube
