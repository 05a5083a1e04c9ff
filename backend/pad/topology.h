// Neighbourhoods in a hexahedral mesh with its boundary quads.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Faces of hexes are "sides": 6 * hex + face, faces as in core/hexahedron.h.
struct HexTopology {
  std::vector<int> mate;        ///< per side: the side on the other hex, or -1 - quad on the boundary (-1 - quads.size() if no quad is listed)
  std::vector<int> quad_side;   ///< per boundary quad: its side, -1 if it is none
  std::vector<int> node_first;  ///< CSR over nodes into node_hexes
  std::vector<int> node_hexes;  ///< hexes round each node, ascending
  std::vector<int> overfull;    ///< sides of faces shared by more than two hexes
};

HexTopology build_topology(const HexMesh& mesh, const std::vector<Quad>& quads);

/// Sides of hexes with the four nodes of a quad, ascending: one on the boundary, two inside.
std::vector<int> sides_at(const HexMesh& mesh, const HexTopology& topology, const Quad& quad);

/// Local corner of node in hex, -1 if it is none of its eight.
int corner_of(const Hex& hex, int node);
/// The face of the hex, other than `face`, that contains the edge (a, b).
int other_face(const Hex& hex, int face, int a, int b);

/// A boundary edge, the quads on its two sides and the hexes between them.
struct BoundaryEdge {
  int a, b;                  ///< nodes, a < b
  std::array<int, 2> quads;  ///< boundary quads, ascending
  int hexes;                 ///< number of hexes round it
};

/// The edges between two listed quads, sorted by (a, b).
std::vector<BoundaryEdge> boundary_edges(const HexMesh& mesh, const std::vector<Quad>& quads, const HexTopology& topology);
/// Index of the edge between two nodes, in any order; -1 if there is none.
int find_edge(const std::vector<BoundaryEdge>& edges, int a, int b);

}  // namespace polycube
