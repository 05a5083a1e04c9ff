// What becomes of a hexahedron of which some edges are divided into three.
#pragma once

#include <cstdint>
#include <vector>

#include "core/types.h"

namespace polycube {

/// A place in a cell, its corners at 0 and 3.
using CellPlace = std::array<int, 3>;
/// Corners of a part of the cell, in the order of core/hexahedron.h.
using CellPart = std::array<CellPlace, 8>;
/// Corners of a cell, bit by bit.
using CornerSet = std::uint8_t;
inline constexpr CornerSet kAllCorners = 0xFF;

/// The smallest set of corners with these that has a template. An edge is divided if both its ends are in the set; a template is there for no such edge, one,
/// the four of one face, and all twelve.
CornerSet with_template(CornerSet corners);

/// The parts of a cell with these corners, a set that has a template. `divided`: along which of its three directions edges are divided at all. Parts of two
/// cells fit together on the face between them: what becomes of it depends on which of its edges are divided alone.
std::vector<CellPart> cell_parts(CornerSet corners, const std::array<bool, 3>& divided);

}  // namespace polycube
