// First geometry: the inverse of the map at the nodes.
#pragma once

#include "hex/connectivity.h"

namespace polycube {

/// Fills mesh.points, param and quad_triangle.
/// A boundary node gets a point of the tet mesh's boundary: on its chart, on the line between its two charts, or at the corner of its
/// three; on a feature's segment or node where the image of the node lies on that.
void place_nodes(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, Connectivity& connectivity, const Monitor& monitor);

}  // namespace polycube
