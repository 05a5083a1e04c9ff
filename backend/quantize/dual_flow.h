// Convex costs on differences of integers, solved exactly as the dual of a minimum-cost flow.
#pragma once

#include <cstdint>
#include <optional>

#include "quantize/problem.h"

namespace polycube {

/// Flow and capacity: weights times AxisNetwork::to_integer.
using FlowInt = std::int64_t;

class AxisFlow;

/// The network of one axis. A difference x = l[high] - l[low] with convex piecewise linear cost is a flow on low -> high: slopes are flow,
/// breakpoints cost; the unknowns are potentials. Not for several threads at once.
class AxisNetwork {
 public:
  struct Arc {
    int from, to;
    FlowInt capacity;
    int cost;
  };
  /// Weights times `to_integer` are rounded to integers; their sum must stay below 2^51. `problem` must outlive the network.
  AxisNetwork(const AxisProblem& problem, double to_integer);

  /// From nothing, by network simplex, with `extra` differences. Empty when the differences contradict each other.
  std::optional<AxisFlow> solve(const std::vector<Difference>& extra) const;

  const AxisProblem& problem() const { return problem_; }

 private:
  friend class AxisFlow;

  const AxisProblem& problem_;
  double to_integer_;
  std::vector<Arc> arcs_;
  std::size_t term_arcs_ = 0;  ///< arcs_ of terms; the rest are differences
  FlowInt total_ = 0;          ///< capacity of the terms' arcs
  double at_best_ = 0;         ///< the terms' sum if every difference could take its own best value
  std::vector<int> first_;     ///< CSR over unknowns into incident_
  std::vector<int> incident_;  ///< arcs
  /// Of the search for paths: unknown is reached where mark equals the round; the arc it was reached by.
  struct Scratch {
    int round = 0;
    std::vector<int> mark, by, reached;
  };
  mutable Scratch scratch_;
};

/// An optimal flow and its potentials. A copy is a warm start: a difference more is repaired where it hurts, on what is there.
class AxisFlow {
 public:
  /// Per unknown, up to a common shift.
  const std::vector<int>& values() const { return value_; }
  /// Value of the flow: no integers have a smaller sum of terms (up to the rounding of weights).
  double bound() const { return bound_ + static_cast<double>(gain_) / network_->to_integer_; }
  int span(int low, int high) const { return value_[high] - value_[low]; }
  bool holds(const Difference& d) const { return span(d.low, d.high) >= d.at_least; }

  /// Demands a difference. False when it contradicts the others; the flow is of no use then.
  bool demand(const Difference& difference);

  /// How much a difference that is one too small can be rewarded before it pays to raise it; at most `limit`. kUnlimited where nothing can
  /// raise it. To be followed by settle().
  FlowInt push(int low, int high, FlowInt limit);
  /// Makes `amount` the reward, or where nothing can raise the difference the price: from now on a difference below 1 costs it.
  void settle(int low, int high, FlowInt amount);
  /// Raises the difference by one where push() was not stopped by its limit and all it returned was settled: that costs nothing.
  void follow(int low, int high);

  static constexpr FlowInt kUnlimited = FlowInt{1} << 60;

 private:
  friend class AxisNetwork;
  struct Extra {
    AxisNetwork::Arc arc;
    FlowInt flow;
    int next_at_from, next_at_to;  ///< lists of extras at an unknown
  };
  struct Path {
    FlowInt amount;
    std::vector<int> arcs;  ///< arc, or -1 - arc against its direction
  };

  const AxisNetwork::Arc& arc(int a) const;
  FlowInt& flow(int a);
  FlowInt residual(int a) const;
  void add_extra(const AxisNetwork::Arc& arc, FlowInt flow);
  template <class Visit>
  void for_residual(int node, const Visit& visit) const;
  /// Path of residual arcs of reduced cost 0, as short as any.
  bool find_path(int from, int to, Path& path) const;
  void send(const Path& path, FlowInt amount);
  /// Lowers what find_path reached, by `most` or less, as far as reduced costs allow.
  void lower_reached(int most);

  const AxisNetwork* network_ = nullptr;
  std::vector<int> value_;
  std::vector<FlowInt> flow_;
  std::vector<Extra> extras_;
  std::vector<int> extra_first_;
  double bound_ = 0;
  FlowInt gain_ = 0;          ///< since bound_ was computed
  std::vector<Path> pushed_;  ///< by the last push()
};

/// Differences that cannot hold together: a cycle with positive sum. Empty when they can.
std::vector<Difference> contradiction(const AxisProblem& problem, const std::vector<Difference>& extra);

}  // namespace polycube
