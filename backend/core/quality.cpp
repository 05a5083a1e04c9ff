#include "core/quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hexahedron.h"

namespace polycube {

double corner_scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex, int corner) {
  const Vec3& c = points[hex[corner]];
  const auto& n = kCornerNeighbours[corner];
  const Vec3 a = points[hex[n[0]]] - c, b = points[hex[n[1]]] - c, d = points[hex[n[2]]] - c;
  const double lengths = a.norm() * b.norm() * d.norm();
  return lengths > 0 ? a.dot(b.cross(d)) / lengths : -1.0;
}

double scaled_jacobian(const std::vector<Vec3>& points, const Hex& hex) {
  double worst = std::numeric_limits<double>::infinity();
  for (int c = 0; c < 8; ++c) worst = std::min(worst, corner_scaled_jacobian(points, hex, c));
  return worst;
}

QualitySummary summarise(const HexMesh& mesh) {
  QualitySummary s;
  if (mesh.hexes.empty()) return s;
  s.min_scaled_jacobian = std::numeric_limits<double>::infinity();
  for (const Hex& h : mesh.hexes) {
    const double q = scaled_jacobian(mesh.points, h);
    s.min_scaled_jacobian = std::min(s.min_scaled_jacobian, q);
    s.mean_scaled_jacobian += q;
    if (q <= 0) {
      ++s.inverted;
    } else {
      ++s.histogram[std::clamp(static_cast<int>(std::ceil(q * 10)) - 1, 0, 9)];
    }
  }
  s.mean_scaled_jacobian /= static_cast<double>(mesh.hexes.size());
  return s;
}

double hex_volume(const std::vector<Vec3>& points, const Hex& hex) {
  const double g = 1 / std::sqrt(3.0);
  double volume = 0;
  for (int k = 0; k < 8; ++k) {
    const auto& at = kCornerCoordinates[k];
    const Vec3 q(g * (2 * at[0] - 1), g * (2 * at[1] - 1), g * (2 * at[2] - 1));
    Mat3 jacobian = Mat3::Zero();
    for (int i = 0; i < 8; ++i) {
      const auto& ci = kCornerCoordinates[i];
      const Vec3 r(2 * ci[0] - 1, 2 * ci[1] - 1, 2 * ci[2] - 1);
      const Vec3 s = Vec3::Ones() + r.cwiseProduct(q);
      const Vec3 gradient(r[0] * s[1] * s[2] / 8, s[0] * r[1] * s[2] / 8, s[0] * s[1] * r[2] / 8);
      jacobian += points[hex[i]] * gradient.transpose();
    }
    volume += jacobian.determinant();
  }
  return volume;
}

}  // namespace polycube
