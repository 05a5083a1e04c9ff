// What the stage deform chose; what the words mean: core/tuned.h.
#pragma once

#include <cstddef>

#include "core/tuned.h"

namespace polycube {

struct DeformTuning {
  /// Rounds after which the planes of the charts are compared. Guess.
  int trial_rounds = 4;
  /// Weight of keeping volume against keeping angles. Guess.
  double lambda = 0.5;
  /// Updates of epsilon. Guess.
  int outer = 12;
  /// Steps of L-BFGS between them. Guess.
  int inner = 25;
  /// Updates without fewer flips before it ends. Guess.
  int patience = 6;
  /// Times the flips at the start: it has run away. Guess.
  int runaway = 60;
  /// Largest epsilon. Theory: a tet without size costs 2 lambda / epsilon, a good one 3 + 2 lambda, so at 0.25 shrinking the part to a point pays.
  double widest = 0.1;
  /// Epsilon at most, of the last one. Guess.
  double fall = 0.6;
  /// Steps that L-BFGS remembers. Guess.
  std::size_t memory = 6;
  /// Unknowns of a level that are solved for directly. Guess.
  int coarsest = 600;
  /// Share of the unknowns of a level that the next may have; with more there is none. Guess.
  double least_gain = 0.8;
  /// Of the geometric mean of the diagonals: weaker couplings do not make unknowns hang together. Guess.
  double weak = 0.02;
  /// Times the mean entries of a row. Theory: the unknown of a chart is a group of its own, or the group would be all that lies along the chart.
  int dense = 4;
  /// Steps of the power iteration for the largest eigenvalue. Guess.
  int power_steps = 12;
  /// What it is multiplied by for what they fall short. Guess.
  double power_margin = 1.1;
  /// Of the right side: what a solution may leave. Measured: a box comes out as it is to 1e-9 (tests/unit/deform).
  double residual = 1e-10;
  /// Steps of conjugate gradients, which take 2 to 18; more are a fault. Guess.
  int most_steps = 200;
  /// Rounds of rotations and solutions after the first one (DeformOptions). Guess.
  int rotations = 12;

  POLYCUBE_ENTRIES(trial_rounds, lambda, outer, inner, patience, runaway, widest, fall, memory, coarsest, least_gain, weak, dense, power_steps, power_margin,
                   residual, most_steps, rotations)
};

inline constexpr const DeformTuning& kDeformTuning = tuning_in_force<DeformTuning>;

}  // namespace polycube
