// Adjacency of tetrahedra.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Corners of the facet opposite to each corner, outward on a positive tet.
inline constexpr std::array<std::array<int, 3>, 4> kTetFacets{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

struct TetTopology {
  std::vector<std::array<int, 4>> neighbours;  ///< per tet and facet: the tet behind it, or -1
  std::vector<std::array<int, 4>> triangles;   ///< per tet and facet: the boundary triangle on it, or -1
  std::vector<int> node_tets_first;            ///< CSR over points
  std::vector<int> node_tets;
};

/// Throws InvalidInput when a facet has more than two tets, or the boundary triangles are not exactly the facets with one.
TetTopology find_topology(const TetMesh& mesh);

}  // namespace polycube
