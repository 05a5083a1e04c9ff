// Quality of hexahedra, as the field (Verdict) and hexjudge-like tools define it.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// Scaled Jacobian of one corner: det of the three unit edge vectors; -1 where an edge has no length.
double corner_scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex, int corner);

/// Smallest of the eight corner scaled Jacobians: 1 for a cube, <= 0 for an inverted cell.
double scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex);

struct QualitySummary {
  double min_scaled_jacobian = 0;
  double mean_scaled_jacobian = 0;
  int inverted = 0;                  ///< cells with scaled Jacobian <= 0
  std::array<int, 10> histogram{};   ///< cells per tenth of scaled Jacobian in (0, 1]; inverted ones are not in it
};

QualitySummary summarise(const HexMesh& mesh);

/// Volume of a trilinear cell, exact (2 x 2 x 2 Gauss points).
double hex_volume(const std::vector<Vec3>& points, const Hex& hex);

}  // namespace polycube
