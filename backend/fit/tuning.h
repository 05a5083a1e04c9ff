// What the stage fit chose; what the words mean: core/tuned.h.
#pragma once

#include <cstddef>
#include <numbers>

#include "core/tuned.h"

namespace polycube {

struct FitTuning {
  /// Inverted cells worth another start: more of them have a cause that none mends. Guess.
  int few = 4;
  /// Of a prospect: for less the candidate that its maker puts first stays there. Guess.
  double doubt = 0.01;
  /// Rounds of averaging the wanted edge lengths with the neighbours'. Guess.
  int size_smoothing = 4;
  /// Scaled Jacobian up to which a cell counts as inverted: nodes of a face that projection took onto its border leave cells positive by rounding alone. Guess.
  double flat = 1e-3;
  /// Scaled Jacobian up to which a cell may be inverted inside though its corners are not. Guess.
  double poor = 0.3;
  /// Cosine: so may any cell whose edges along one axis are further from their mean than this. Guess.
  double twisted = 0.85;
  /// Cosine of the angle of CAD edges or faces that hold a corner: from 60 degrees on other cells would do better. Guess.
  double narrow = 0.5;
  /// Of what such an angle allows: a corner as good as this is as good as can be. Guess.
  double nearly = 0.95;
  /// First rounds of untangling, after which it is to be seen what will come of it. Guess.
  int first_rounds = 8;
  /// Rounds of mending few inverted cells for a prospect. Guess.
  int prospect_rounds = 8;
  /// Weight of the worst cell against the mean in a prospect, and while cells are evened out. Guess.
  double worst_weight = 0.3;
  /// Rounds of taking nodes to the mean of their neighbours. Guess.
  int smooth_rounds = 10;
  /// Rounds of untangling without a gain after which it ends. Guess.
  int patience = 6;
  /// Gain of a round of untangling below which it has converged. Guess.
  double converged = 5e-3;
  /// Cells an inverted one: as rare ones are left to what works on their surroundings alone. Guess.
  int rare = 1000;
  /// Stages of raising the worst cells, each with more of their surroundings. Guess.
  int raise_stages = 4;
  /// Doublings of the power from one stage to the next, at most. Guess.
  int raise_highest = 2;
  /// Scaled Jacobian that a round brings at least. Guess.
  double raise_progress = 0.005;
  /// Of the worst cell: where it is held while the whole mesh is polished and evened out. Guess.
  double held = 0.98;
  /// The floor over the worst scaled Jacobian there, while that is below the goal. Guess.
  double raising = 1.2;
  /// Weight of the shape term there, which holds cells to the sizes they have. Measured: i09 after 500 steps .826 at .1, .831 at .02, .830 at .004.
  double even_shape = 0.02;
  /// The same where cells keep their sizes: as in the steps before. Guess.
  double kept_shape = 0.1;
  /// Even power by which a cell's worst corner stands for it. Measured: mean of i09 after 500 steps .831 at 16, .835 at 32; one power 2 a corner .813.
  int gathered = 32;
  /// Scaled Jacobian from which a cell is left alone then. Measured: at .95 i01 comes to .950 of the mean, at 1.1, which takes in all, to .951.
  double even_good = 0.95;
  /// Layers round the others that are moved with them. Guess.
  int even_layers = 2;
  /// Descents of evening out. Guess.
  int even_rounds = 6;
  /// Steps of each. Guess.
  int even_steps = 100;
  /// Mean scaled Jacobian that one brings at least, with the worst in its weight, lest it be the last. Measured: at 5e-4 i20 takes 13.5 s of the processor, at
  /// 2e-3 11.6 s, i24 19.9 s and 18.4 s, for .001 and .002 of the mean.
  double even_gain = 3e-3;
  /// Below the target a worst cell that rises by this is reason enough to go on. Measured: i20 .222 to .301 in six descents, the least step 1.005.
  double rising = 1.003;
  /// What the floor rises by where it did not hold them. Guess.
  double higher = 1.1;
  /// Up to this. Guess.
  double highest = 1.5;
  /// Wanted lengths: an edge as short as this is as bad as a cell is good. Guess.
  double short_edge = 0.15;
  /// Radians: a mesh edge along which its curve turns by this is as bad as a cell is good. Guess.
  double wide_turn = std::numbers::pi / 12;
  /// Weight of such an edge. Theory: cells share a mesh edge.
  double turn_weight = 4;
  /// Half the power of the floor, which is even. Guess.
  int half_floor_power = 8;
  /// Pairs that L-BFGS remembers. Guess.
  std::size_t memory = 8;
  /// While cells are evened out. Measured: i09 after 600 steps .811 at 8, .819 at 16.
  std::size_t long_memory = 16;
  /// Radians: an entity that turns by this under a node is no longer known to second order. Guess.
  double far_turn = 0.7;
  /// Wanted lengths that a node goes in one iteration. Guess.
  double longest_step = 0.4;
  /// Radians: CAD edges that turn by less in all are straight. Guess.
  double straight = 0.3;
  /// Samples of the length along a CAD edge. Guess.
  int samples = 257;
  /// Longest to shortest wanted length of a cell. Guess.
  double widest_aspect = 8;
  /// Work on worse cells goes on until this (FitOptions). Guess.
  double target_scaled_jacobian = 0.3;
  /// Rounds of it (FitOptions). Guess.
  int max_rounds = 60;

  POLYCUBE_ENTRIES(few, doubt, size_smoothing, flat, poor, twisted, narrow, nearly, first_rounds, prospect_rounds, worst_weight, smooth_rounds, patience,
                   converged, rare, raise_stages, raise_highest, raise_progress, held, raising, even_shape, kept_shape, gathered, even_good, even_layers,
                   even_rounds, even_steps, even_gain, rising, higher, highest, short_edge, wide_turn, turn_weight, half_floor_power, memory, long_memory,
                   far_turn, longest_step, straight, samples, widest_aspect, target_scaled_jacobian, max_rounds)
};

inline constexpr const FitTuning& kFitTuning = tuning_in_force<FitTuning>;

}  // namespace polycube
