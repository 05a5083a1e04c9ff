// Branch and bound over the alternatives of C2.
#pragma once

#include <memory>

#include "quantize/dual_flow.h"
#include "quantize/monotone.h"

namespace polycube {

/// Integers per axis and unknown.
using AxisValues = std::array<std::vector<int>, 3>;

class Search {
 public:
  /// Everything must outlive the search.
  Search(const QuantizeProblem& problem, const MonotonePaths& paths, int node_limit, const Monitor& monitor);

  struct Outcome {
    bool found = false;        ///< false: no integers satisfy all constraints
    int infeasible_axis = -1;  ///< an axis whose differences alone contradict each other
    AxisValues values;
  };
  /// Fills all of the result but `value`.
  Outcome run(Quantization& result);

 private:
  struct Node {
    int id = 0;
    double bound = 0;
    bool raised = false;  ///< bound has been raised by rewards
    std::array<std::shared_ptr<const AxisFlow>, 3> flows;
    std::array<std::vector<Difference>, 3> decided;  ///< by branching
  };
  using NodePtr = std::shared_ptr<Node>;
  struct Later {
    bool operator()(const NodePtr& a, const NodePtr& b) const { return a->bound != b->bound ? a->bound > b->bound : a->id < b->id; }
  };

  /// What takes the place of a node: nothing (solved or infeasible), itself with a better bound, or its children.
  std::vector<NodePtr> expand(const NodePtr& node);
  bool renew(Node& node);
  bool raise(Node& node, std::vector<Cut2> violated);
  std::vector<NodePtr> branch(const Node& node, const std::vector<Cut2>& violated);
  std::vector<NodePtr> split(const Node& node, const Cut2& cut);
  std::shared_ptr<const AxisFlow> solve_axis(int axis, const std::vector<Difference>& extra);
  std::vector<Cut2> violations(const std::array<const std::vector<int>*, 3>& values);
  bool keep_forced(const std::vector<Cut2>& violated);
  void offer(const std::array<const std::vector<int>*, 3>& values);
  static double bound_of(const Node& node);

  const QuantizeProblem& problem_;
  const MonotonePaths& paths_;
  const int node_limit_;
  const Monitor& monitor_;
  std::vector<AxisNetwork> networks_;
  double to_integer_ = 0;
  double tie_ = 0;                                 ///< objectives nearer than this are equal: the flows' weights are rounded
  std::array<std::vector<Difference>, 3> always_;  ///< C2 constraints with one alternative, sorted
  std::vector<Cut2> seen_;                         ///< sorted
  AxisValues best_;
  double best_objective_ = std::numeric_limits<double>::infinity();
  int nodes_ = 0, rounds_ = 0, solved_ = 0, repaired_ = 0;
};

}  // namespace polycube
