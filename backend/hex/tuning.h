// What the stage hex chose; what the words mean: core/tuned.h.
#pragma once

#include "core/tuned.h"

namespace polycube {

struct HexTuning {
  /// Barycentric coordinates this far outside still count as inside. Guess.
  double inside = 1e-9;
  /// Of the image's extent: a node as near as this is on a feature's image. Guess.
  double on_feature = 1e-7;
  /// Halvings of the interval that the largest cell is looked for in. Theory: none is left of a double's 53 digits.
  int halvings = 60;

  POLYCUBE_ENTRIES(inside, on_feature, halvings)
};

inline constexpr const HexTuning& kHexTuning = tuning_in_force<HexTuning>;

}  // namespace polycube
