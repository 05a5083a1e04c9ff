// What the stage fem chose; what the words mean: core/tuned.h.
#pragma once

#include "core/tuned.h"

namespace polycube {

/// Of curving (curve.cpp). A cell's share is the least ratio, over the points of fem/element.h, of its Jacobian to that with straight edges.
struct FemTuning {
  /// Cells with a smaller share have their nodes moved, as the fit does for the scaled Jacobian. Guess.
  double wanted = 0.3;
  /// What moves do not bring above this share is straightened. Theory: any positive one would do for a solver, this one is out of rounding's reach.
  double accepted = 0.02;
  /// Newton's steps of a node. Guess.
  int steps = 4;
  /// Halvings of a step. Guess.
  int halves = 12;
  /// Longest step, of the edge. Guess.
  double longest = 0.25;
  /// Shortest step, of the edge. Guess.
  double shortest = 1e-9;
  /// Rounds over the nodes with one barrier. Guess.
  int sweeps = 3;
  /// Of the way up to 1: with less gain the barrier comes nearer. Guess.
  double gain = 0.005;
  /// Rounds with other barriers. Guess.
  int rounds = 60;
  /// Distance of the barrier from the least share at first. Guess.
  double margin = 0.2;
  /// Distance at which a cell is given up. Guess.
  double least_margin = 0.02;

  POLYCUBE_ENTRIES(wanted, accepted, steps, halves, longest, shortest, sweeps, gain, rounds, margin, least_margin)
};

inline constexpr const FemTuning& kFemTuning = tuning_in_force<FemTuning>;

}  // namespace polycube
