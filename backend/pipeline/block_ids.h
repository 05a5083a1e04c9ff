// The block of every cell, to be seen by the user.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Blocks of all cells of a mesh whose first cells have `blocks` and whose later ones were added to them by padding: each of those takes the
/// block of the cell that it is reached from through the fewest faces.
std::vector<int> carry_blocks(const HexMesh& mesh, std::vector<int> blocks);

}  // namespace polycube
