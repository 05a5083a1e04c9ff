// Layers through several solids: under what is one smooth surface outside, though an interface ends on it.
#pragma once

#include "pipeline/conform_grid.h"

namespace polycube {

/// Layers under the outside of all solids together, as pad_choices lays them for one; interfaces go on through them. Those of which the parts cannot be told,
/// and those that add nothing, are left out. `grids`: solids, and the same in one.
std::vector<PaddedGrids> pad_across(const ConformalModel& model, const PaddedGrids& grids, const Monitor& monitor);

}  // namespace polycube
