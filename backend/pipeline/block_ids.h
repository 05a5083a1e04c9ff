// The block of every cell, to be seen by the user.
#pragma once

#include <set>

#include "core/mesh.h"

namespace polycube {

/// Blocks of all cells of a mesh whose first cells have `blocks` and whose later ones were added to them by padding: each of those takes the
/// block of the cell that it is reached from through the fewest faces, none of them among `walls` (nodes ascending).
std::vector<int> carry_blocks(const HexMesh& mesh, std::vector<int> blocks, const std::set<Quad>& walls = {});

}  // namespace polycube
