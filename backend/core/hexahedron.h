// The one numbering of the hexahedron used inside Polycube: VTK's.
//
//        7--------6          faces (outward), edges and corner frames refer to this drawing;
//       /|       /|          corner c has the right-handed neighbours kCornerNeighbours[c]
//      4--------5 |
//      | |      | |          w ^  v
//      | 3------|-2            | /
//      |/       |/             |/
//      0--------1              +---> u
//
#pragma once

#include "core/mesh.h"

namespace polycube {

inline constexpr std::array<std::array<int, 4>, 6> kHexFaces{{
    {0, 4, 7, 3},  // -u
    {1, 2, 6, 5},  // +u
    {0, 1, 5, 4},  // -v
    {3, 7, 6, 2},  // +v
    {0, 3, 2, 1},  // -w
    {4, 5, 6, 7},  // +w
}};

/// Edges in the order of VTK's and Abaqus' 20-node hexahedron: bottom ring, top ring, verticals.
inline constexpr std::array<std::array<int, 2>, 12> kHexEdges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Per corner its three neighbours, right-handed: det(n0-c, n1-c, n2-c) > 0 in a good cell.
inline constexpr std::array<std::array<int, 3>, 8> kCornerNeighbours{{{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// Integer coordinates (u, v, w) of the corners.
inline constexpr std::array<std::array<int, 3>, 8> kCornerCoordinates{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// The axis (0, 1, 2) along which two corners of a hex differ, -1 if they share no edge.
constexpr int edge_axis(int c, int d) {
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (kCornerCoordinates[c][k] == kCornerCoordinates[d][k]) continue;
    if (axis >= 0) return -1;
    axis = k;
  }
  return axis;
}

}  // namespace polycube
