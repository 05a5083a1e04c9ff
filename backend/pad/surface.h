// Which boundary quads need a layer under them.
#pragma once

#include "pad/pad.h"
#include "pad/topology.h"

namespace polycube {

/// Cost of dividing an angle (radians) among `cells` cells: 0 at 90 degrees each, growing as their best possible scaled Jacobian falls, at least 1000
/// where a cell would have to span 150 degrees or more.
double angle_cost(int cells, double angle);

/// Interior dihedral angle of the CAD at each boundary edge, radians: pi where both quads lie on one patch without a CAD edge between.
std::vector<double> dihedral_angles(const CadModel& model, const HexMesh& mesh, const Association& association,
                                    const std::vector<BoundaryEdge>& edges);

/// Per boundary quad: whether it gets a layer. Least total angle_cost over the edges plus a price per quad, among the choices that are whole smooth
/// regions and fit for insert_sheet.
std::vector<char> choose_surface(const HexMesh& mesh, const Association& association, const std::vector<BoundaryEdge>& edges,
                                 const std::vector<double>& angles, const Monitor& monitor);

}  // namespace polycube
