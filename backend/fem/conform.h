// Groups of a mesh of several solids with common nodes.
#pragma once

#include "cad/conformal.h"
#include "fem/fem.h"

namespace polycube {

/// A mesh on the joined model gets solids, faces, edges and groups by what they were before (ConformalModel::origins, numbers). `hex_solid`: per hex the index
/// of its solid; `point_cad`: of the corners, as in Association. A quad between two solids has its hex in the first of them.
void name_by_origin(FemMesh& mesh, const ConformalModel& model, const std::vector<int>& hex_solid, const std::vector<CadRef>& point_cad);

}  // namespace polycube
