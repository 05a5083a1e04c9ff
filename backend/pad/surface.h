// Which boundary quads need a layer under them.
#pragma once

#include "pad/angles.h"

namespace polycube {

/// Per boundary quad: whether it gets a layer. Least total angle_cost over the edges plus a price per quad, among the choices that are whole smooth
/// regions and fit for insert_sheet.
std::vector<char> choose_surface(const HexMesh& mesh, const Association& association, const std::vector<BoundaryEdge>& edges,
                                 const std::vector<double>& angles, const Monitor& monitor);

}  // namespace polycube
