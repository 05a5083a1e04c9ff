// The serendipity brick of 20 nodes: the determinant of its Jacobian where it has to be positive. Private to fem.
#pragma once

#include <vector>

#include "core/mesh.h"

namespace polycube {

/// Points of the reference cube [-1, 1]^3 at which cells are judged: the 8 corners, the 3 x 3 x 3 Gauss points that solvers use, then the
/// middles of edges and faces.
inline constexpr int kSolverPoints = 8 + 27;
inline constexpr int kPoints = kSolverPoints + 12 + 6;

/// Places of a cell's nodes, one column each, in the order of core/hexahedron.h: corners, then the middles of kHexEdges.
using Hex20 = std::array<int, 20>;
using HexPlaces = Eigen::Matrix<double, 3, 20>;
using Determinants = Eigen::Array<double, kPoints, 1>;
/// How the determinants change with the place of one node: they are linear in it, one column a point.
using DeterminantSlopes = Eigen::Matrix<double, 3, kPoints>;

HexPlaces straight_places(const std::vector<Vec3>& points, const Hex20& hex);
HexPlaces curved_places(const std::vector<Vec3>& points, const Hex20& hex);

Determinants determinants(const HexPlaces& places);
/// The same, and their slopes by the place of one node, 0 to 19.
Determinants determinants(const HexPlaces& places, int node, DeterminantSlopes& slopes);

}  // namespace polycube
