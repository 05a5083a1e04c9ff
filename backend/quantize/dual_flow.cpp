#include "quantize/dual_flow.h"

#include <lemon/network_simplex.h>
#include <lemon/smart_graph.h>

#include <algorithm>
#include <cmath>

namespace polycube {
namespace {

/// |x - target| between the integers around the target is replaced by its chord: equal at integers, and breakpoints become integers.
struct Breakpoint {
  int at;
  FlowInt jump;  ///< of the slope
};

}  // namespace

AxisNetwork::AxisNetwork(const AxisProblem& problem, double to_integer) : problem_(problem), to_integer_(to_integer) {
  const auto& terms = problem.terms;
  std::vector<Breakpoint> breakpoints;
  for (std::size_t i = 0; i < terms.size();) {
    const int low = terms[i].low, high = terms[i].high;
    const std::size_t begin = i;
    breakpoints.clear();
    FlowInt slope = 0;
    for (; i < terms.size() && terms[i].low == low && terms[i].high == high; ++i) {
      const FlowInt weight = std::llround(terms[i].weight * to_integer);
      const double below = std::floor(terms[i].target);
      const FlowInt first = std::clamp<FlowInt>(std::llround(2.0 * static_cast<double>(weight) * (below + 1 - terms[i].target)), 0, 2 * weight);
      if (first > 0) breakpoints.push_back({static_cast<int>(below), first});
      if (first < 2 * weight) breakpoints.push_back({static_cast<int>(below) + 1, 2 * weight - first});
      slope -= weight;
    }
    std::stable_sort(breakpoints.begin(), breakpoints.end(), [](const Breakpoint& a, const Breakpoint& b) { return a.at < b.at; });
    for (const Breakpoint& b : breakpoints) {
      // The part of the jump below slope 0 is flow against the arc, the part above flow along it.
      const FlowInt down = std::clamp<FlowInt>(-slope, 0, b.jump), up = b.jump - down;
      if (down > 0) arcs_.push_back({high, low, down, -b.at});
      if (up > 0) arcs_.push_back({low, high, up, b.at});
      if (slope < 0 && slope + b.jump >= 0) {
        for (std::size_t k = begin; k < i; ++k) at_best_ += terms[k].weight * std::abs(b.at - terms[k].target);
      }
      slope += b.jump;
      total_ += b.jump;
    }
  }
  term_arcs_ = arcs_.size();
  for (const Difference& d : problem.differences) arcs_.push_back({d.high, d.low, 2 * AxisFlow::kUnlimited, -d.at_least});

  first_.assign(problem.charts.size() + 1, 0);
  for (const Arc& a : arcs_) {
    ++first_[a.from + 1];
    ++first_[a.to + 1];
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  incident_.resize(2 * arcs_.size());
  auto fill = first_;
  for (int a = 0; a < static_cast<int>(arcs_.size()); ++a) {
    incident_[fill[arcs_[a].from]++] = a;
    incident_[fill[arcs_[a].to]++] = a;
  }
  scratch_.mark.assign(problem.charts.size(), 0);
  scratch_.by.assign(problem.charts.size(), 0);
}

std::optional<AxisFlow> AxisNetwork::solve(const std::vector<Difference>& extra) const {
  const int n = static_cast<int>(problem_.charts.size());
  // Without a contradiction every cycle of the optimal flow has an arc of a term, so this capacity is never used up.
  const FlowInt unlimited = total_ + 1;
  lemon::SmartDigraph graph;
  graph.reserveNode(n);
  graph.reserveArc(static_cast<int>(arcs_.size() + extra.size()));
  for (int i = 0; i < n; ++i) graph.addNode();
  for (const Arc& a : arcs_) graph.addArc(graph.nodeFromId(a.from), graph.nodeFromId(a.to));
  for (const Difference& d : extra) graph.addArc(graph.nodeFromId(d.high), graph.nodeFromId(d.low));
  lemon::SmartDigraph::ArcMap<FlowInt> upper(graph), cost(graph);
  for (int a = 0; a < graph.arcNum(); ++a) {
    const bool term = a < static_cast<int>(term_arcs_), own = a < static_cast<int>(arcs_.size());
    upper[graph.arcFromId(a)] = term ? arcs_[a].capacity : unlimited;
    cost[graph.arcFromId(a)] = own ? arcs_[a].cost : -extra[a - arcs_.size()].at_least;
  }
  lemon::NetworkSimplex<lemon::SmartDigraph, FlowInt, FlowInt> simplex(graph);
  simplex.upperMap(upper).costMap(cost);
  simplex.run();

  AxisFlow result;
  result.network_ = this;
  result.value_.resize(n);
  for (int i = 0; i < n; ++i) result.value_[i] = static_cast<int>(simplex.potential(graph.nodeFromId(i)));
  const auto holds = [&](const Difference& d) { return result.holds(d); };
  if (!std::all_of(problem_.differences.begin(), problem_.differences.end(), holds) || !std::all_of(extra.begin(), extra.end(), holds)) {
    return std::nullopt;
  }
  double saved = 0;
  result.flow_.resize(arcs_.size());
  result.extra_first_.assign(n, -1);
  for (int a = 0; a < graph.arcNum(); ++a) {
    const FlowInt flow = simplex.flow(graph.arcFromId(a));
    saved -= static_cast<double>(flow) * static_cast<double>(cost[graph.arcFromId(a)]);
    if (a < static_cast<int>(arcs_.size())) {
      result.flow_[a] = flow;
    } else {
      const Difference& d = extra[a - arcs_.size()];
      result.add_extra({d.high, d.low, 2 * AxisFlow::kUnlimited, -d.at_least}, flow);
    }
  }
  result.bound_ = at_best_ + saved / to_integer_;
  return result;
}

const AxisNetwork::Arc& AxisFlow::arc(int a) const {
  const int own = static_cast<int>(network_->arcs_.size());
  return a < own ? network_->arcs_[a] : extras_[a - own].arc;
}

FlowInt& AxisFlow::flow(int a) {
  const int own = static_cast<int>(network_->arcs_.size());
  return a < own ? flow_[a] : extras_[a - own].flow;
}

FlowInt AxisFlow::residual(int a) const {
  const int own = static_cast<int>(network_->arcs_.size()), at = a >= 0 ? a : -1 - a;
  const FlowInt flowing = at < own ? flow_[at] : extras_[at - own].flow;
  return a >= 0 ? arc(at).capacity - flowing : flowing;
}

void AxisFlow::add_extra(const AxisNetwork::Arc& arc, FlowInt flow) {
  extras_.push_back({arc, flow, extra_first_[arc.from], extra_first_[arc.to]});
  extra_first_[arc.from] = extra_first_[arc.to] = static_cast<int>(extras_.size()) - 1;
}

/// visit(arc or -1 - arc, head, residual capacity, reduced cost)
template <class Visit>
void AxisFlow::for_residual(int node, const Visit& visit) const {
  const auto both = [&](int a, const AxisNetwork::Arc& arc, FlowInt flow) {
    const int cost = arc.cost + value_[arc.from] - value_[arc.to];
    if (arc.from == node) {
      if (flow < arc.capacity) visit(a, arc.to, arc.capacity - flow, cost);
    } else if (flow > 0) {
      visit(-1 - a, arc.from, flow, -cost);
    }
  };
  for (int i = network_->first_[node]; i < network_->first_[node + 1]; ++i) {
    const int a = network_->incident_[i];
    both(a, network_->arcs_[a], flow_[a]);
  }
  for (int e = extra_first_[node]; e >= 0; e = extras_[e].arc.from == node ? extras_[e].next_at_from : extras_[e].next_at_to) {
    both(static_cast<int>(network_->arcs_.size()) + e, extras_[e].arc, extras_[e].flow);
  }
}

bool AxisFlow::find_path(int from, int to, Path& path) const {
  auto& scratch = network_->scratch_;
  auto &mark = scratch.mark, &by = scratch.by, &reached = scratch.reached;
  const int round = ++scratch.round;
  reached.assign(1, from);
  mark[from] = round;
  for (std::size_t i = 0; i < reached.size() && mark[to] != round; ++i) {
    for_residual(reached[i], [&](int a, int head, FlowInt, int cost) {
      if (cost != 0 || mark[head] == round) return;
      mark[head] = round;
      by[head] = a;
      reached.push_back(head);
    });
  }
  if (mark[to] != round) return false;
  path.arcs.clear();
  path.amount = 2 * kUnlimited;
  for (int at = to; at != from;) {
    const int a = by[at];
    path.arcs.push_back(a);
    const AxisNetwork::Arc& used = arc(a >= 0 ? a : -1 - a);
    path.amount = std::min(path.amount, residual(a));
    at = a >= 0 ? used.from : used.to;
  }
  return true;
}

void AxisFlow::send(const Path& path, FlowInt amount) {
  for (int a : path.arcs) flow(a >= 0 ? a : -1 - a) += a >= 0 ? amount : -amount;
}

void AxisFlow::lower_reached(int most) {
  const auto& scratch = network_->scratch_;
  if (most > 1) {
    for (int node : scratch.reached) {
      for_residual(node, [&](int, int head, FlowInt, int cost) {
        if (scratch.mark[head] != scratch.round) most = std::min(most, cost);
      });
    }
  }
  for (int node : scratch.reached) value_[node] -= most;
}

bool AxisFlow::demand(const Difference& d) {
  FlowInt sent = 0;
  Path path;
  while (!holds(d)) {
    const int missing = d.at_least - span(d.low, d.high);
    if (find_path(d.low, d.high, path)) {
      if (path.amount >= kUnlimited) return false;
      send(path, path.amount);
      sent += path.amount;
      gain_ += path.amount * missing;
    } else {
      lower_reached(missing);
    }
  }
  add_extra({d.high, d.low, 2 * kUnlimited, -d.at_least}, sent);
  return true;
}

FlowInt AxisFlow::push(int low, int high, FlowInt limit) {
  FlowInt sent = 0;
  pushed_.clear();
  Path path;
  while (sent < limit && find_path(low, high, path)) {
    // What has been sent stays: settle() wants some or all of it.
    if (path.amount >= kUnlimited && limit >= kUnlimited) return kUnlimited;
    path.amount = std::min(path.amount, limit - sent);
    send(path, path.amount);
    sent += path.amount;
    pushed_.push_back(path);
  }
  return sent;
}

void AxisFlow::settle(int low, int high, FlowInt amount) {
  FlowInt sent = 0;
  for (const Path& path : pushed_) sent += path.amount;
  for (; sent > amount; pushed_.pop_back()) {
    const FlowInt back = std::min(pushed_.back().amount, sent - amount);
    send(pushed_.back(), -back);
    sent -= back;
  }
  Path path;
  while (sent < amount && find_path(low, high, path)) {
    const FlowInt more = std::min(path.amount, amount - sent);
    send(path, more);
    sent += more;
  }
  pushed_.clear();
  gain_ += amount;
  add_extra({high, low, amount, -1}, amount);
}

void AxisFlow::follow(int low, int high) {
  Path path;
  if (!find_path(low, high, path)) lower_reached(1);
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
