// What the stage core chose; what the words mean: core/tuned.h.
#pragma once

#include "core/tuned.h"

namespace polycube {

struct CoreTuning {
  /// Longest edge where no size is given: the part's diagonal over this. Guess.
  double longest_per_diagonal = 15;
  /// Edge to come near to where neither a size nor anything else asks for smaller ones: the diagonal over this. Measured: with 15 the mean scaled Jacobian of
  /// 27 parts is lower.
  double sizes_per_diagonal = 20;
  /// Elements of second order through a wall. Theory: each is linear in strain, two show where bending turns it.
  int layers_of_second_order = 2;
  /// Elements of first order through a wall. Theory: three do as well in bending with C3D8I as two of second order.
  int layers_of_first_order = 3;
  /// Of its volume that a tet keeps at least when one of its nodes is moved. Guess.
  double least_share = 0.1;

  POLYCUBE_ENTRIES(longest_per_diagonal, sizes_per_diagonal, layers_of_second_order, layers_of_first_order, least_share)
};

inline constexpr const CoreTuning& kCoreTuning = tuning_in_force<CoreTuning>;

}  // namespace polycube
