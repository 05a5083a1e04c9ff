// Quality of hexahedra, as the field defines it: Stimpson, Ernst, Knupp, Pebay, Thompson, "The Verdict Geometric Quality Library" (SAND2007-1751).
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Scaled Jacobian of one corner: det of the three unit edge vectors; -1 where an edge has no length.
double corner_scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex, int corner);

/// Smallest of the eight corner scaled Jacobians: 1 for a cube, <= 0 for an inverted cell.
double scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex);

/// The points at which a 20-node hexahedron is integrated, three an axis of [-1, 1]^3, the last axis fastest.
inline constexpr int kInnerPoints = 27;
using InnerDerivatives = Eigen::Matrix<double, kInnerPoints, 8>;
/// Per axis of [-1, 1]^3: the derivatives of the trilinear map at these points, by the places of the corners.
const std::array<InnerDerivatives, 3>& inner_derivatives();

/// Smallest determinant of the trilinear map at the 3 x 3 x 3 Gauss points: it can be negative where all corners are positive.
double least_inner_determinant(const std::vector<Vec3>& points, const Hex& hex);

struct QualitySummary {
  double min_scaled_jacobian = 0;
  double mean_scaled_jacobian = 0;
  int inverted = 0;                 ///< cells with scaled Jacobian <= 0
  std::array<int, 10> histogram{};  ///< cells per tenth of scaled Jacobian in (0, 1]; inverted ones are not in it
};

QualitySummary summarise(const HexMesh& mesh);

/// Longest over shortest edge (Verdict's hexahedron edge ratio): 1 is best; infinity where an edge has no length.
double edge_ratio(const std::vector<Vec3>& points, const Hex& hex);

/// Largest |cosine| between the cell's three principal axes, the sums of its four edges each way (Verdict's hexahedron skew): 0 is best, at
/// most 1; 1 where an axis has no length.
double skew(const std::vector<Vec3>& points, const Hex& hex);

/// Of the most warped side: 1 - the smaller cube of the cosines between normals at opposite corners (Verdict's quadrilateral warpage, which
/// has no hexahedral one): 0 for plane sides, at most 2; 1 where a corner has no normal.
double warpage(const std::vector<Vec3>& points, const Hex& hex);

struct Spread {
  double min = 0, mean = 0, max = 0;
};

/// Over all cells; all 0 for a mesh without cells.
struct ShapeSummary {
  Spread edge_ratio, skew, warpage;
};

ShapeSummary summarise_shape(const HexMesh& mesh);

/// Volume of a trilinear cell, exact (2 x 2 x 2 Gauss points).
double hex_volume(const std::vector<Vec3>& points, const Hex& hex);

}  // namespace polycube
