// What the stage quantize chose; what the words mean: core/tuned.h.
#pragma once

#include <cstddef>

#include "core/tuned.h"

namespace polycube {

struct QuantizeTuning {
  /// Of the sum of weighted targets: objectives nearer than this are ties. Theory: above the rounding of as many terms, below any weight that counts.
  double tie = 1e-11;
  /// Violated constraints whose children are solved before one is chosen to branch on. Guess.
  int candidates = 8;
  /// More differences at once than this are solved for from nothing, as cheaper than by repairs. Guess.
  std::size_t repairs = 16;
  /// Rounds of rewards. Guess.
  int reward_rounds = 100;
  /// Rounds of rewards without a better bound before they end. Guess.
  int idle_rounds = 3;
  /// Nodes of the search tree, past which the best solution so far is taken (QuantizeOptions). Guess.
  int node_limit = 20000;

  POLYCUBE_ENTRIES(tie, candidates, repairs, reward_rounds, idle_rounds, node_limit)
};

inline constexpr const QuantizeTuning& kQuantizeTuning = tuning_in_force<QuantizeTuning>;

}  // namespace polycube
