// What the stage blocks chose; what the words mean: core/tuned.h.
#pragma once

#include "core/tuned.h"

namespace polycube {

struct BlocksTuning {
  /// Of the image's extent: values nearer than this are one plane. Theory: they differ by the rounding of the deformation's solver.
  double same_plane = 1e-9;
  /// Of the square of the image's extent: a chart with less net area has none. Guess.
  double no_area = 1e-9;

  POLYCUBE_ENTRIES(same_plane, no_area)
};

inline constexpr const BlocksTuning& kBlocksTuning = tuning_in_force<BlocksTuning>;

}  // namespace polycube
