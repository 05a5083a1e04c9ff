// What the stage tet chose; what the words mean: core/tuned.h.
#pragma once

#include <cstddef>

#include "core/tuned.h"

namespace polycube {

struct TetTuning {
  /// Of the diagonal: further from it than this no node lies on a CAD entity, whose own tolerance may be large. Guess.
  double far = 1e-3;
  /// Of the diagonal: an entity of Gmsh's is the CAD's of the same number, without a look at others, where its nodes are as near as this. Guess.
  double near = 1e-6;
  /// Nodes of an entity whose distances are taken. Guess.
  std::size_t probes = 6;
  /// Times the limit on the processor's time that Gmsh may take by the clock: a process that waits for something works no more. Guess.
  double patience = 4;
  /// Smallest size, as a divisor of the target. Guess.
  double finest = 6;
  /// Of the surface: a face as large as this (a wire, a spring) may be finer still. Guess.
  double main_face = 0.25;
  /// Half the triangles that such a face may get. Guess.
  double main_triangles = 8000;
  /// Samples of a CAD edge. Guess.
  int samples = 9;
  /// Share of the samples whose curvature does not exceed the one that counts: a cone's tip must not refine the whole cone. Guess.
  double quantile = 0.75;
  /// Step in (u, v) to measure the speed of a parameter. Guess.
  double parameter_step = 1e-6;
  /// Step in space to measure a curvature, of the diagonal. Guess.
  double step = 1e-5;
  /// Elements round a full circle of curved faces and edges (TetOptions). Guess.
  double curvature = 12;
  /// Seconds of processor time that one of Gmsh's settings may take (TetOptions). Guess.
  double attempt_limit = 30;

  POLYCUBE_ENTRIES(far, near, probes, patience, finest, main_face, main_triangles, samples, quantile, parameter_step, step, curvature, attempt_limit)
};

inline constexpr const TetTuning& kTetTuning = tuning_in_force<TetTuning>;

}  // namespace polycube
