#include "fem/element.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/hexahedron.h"

namespace polycube {
namespace {

/// Gradients of the shape functions: three columns a point, by the reference coordinates.
using Gradients = Eigen::Matrix<double, 20, 3 * kPoints>;

/// Reference coordinates in [-1, 1]^3 of the 20 nodes.
std::array<Vec3, 20> reference_nodes() {
  std::array<Vec3, 20> nodes;
  for (int c = 0; c < 8; ++c)
    for (int d = 0; d < 3; ++d) nodes[c][d] = 2 * kCornerCoordinates[c][d] - 1;
  for (int e = 0; e < 12; ++e) nodes[8 + e] = (nodes[kHexEdges[e][0]] + nodes[kHexEdges[e][1]]) / 2;
  return nodes;
}

std::vector<Vec3> reference_points() {
  const auto nodes = reference_nodes();
  std::vector<Vec3> at(nodes.begin(), nodes.begin() + 8);
  const double g = std::sqrt(0.6);
  for (double r : {-g, 0.0, g})
    for (double s : {-g, 0.0, g})
      for (double t : {-g, 0.0, g}) at.emplace_back(r, s, t);
  at.insert(at.end(), nodes.begin() + 8, nodes.end());
  for (const auto& face : kHexFaces) at.push_back((nodes[face[0]] + nodes[face[1]] + nodes[face[2]] + nodes[face[3]]) / 4);
  return at;
}

Gradients make_gradients() {
  const auto nodes = reference_nodes();
  const std::vector<Vec3> at = reference_points();
  Gradients gradients;
  for (int p = 0; p < kPoints; ++p) {
    for (int i = 0; i < 20; ++i) {
      for (int d = 0; d < 3; ++d) {
        // The two other directions.
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        const Vec3& x = at[p];
        const Vec3& n = nodes[i];
        const double se = 1 + x[e] * n[e], sf = 1 + x[f] * n[f];
        double& gradient = gradients(i, 3 * p + d);
        if (i < 8) {
          const double sd = 1 + x[d] * n[d];
          gradient = n[d] * se * sf * (x.dot(n) - 2 + sd) / 8;
        } else if (n[d] == 0) {
          gradient = -2 * x[d] * se * sf / 4;
        } else {
          const double bubble_e = n[e] == 0 ? 1 - x[e] * x[e] : se, bubble_f = n[f] == 0 ? 1 - x[f] * x[f] : sf;
          gradient = n[d] * bubble_e * bubble_f / 4;
        }
      }
    }
  }
  return gradients;
}

const Gradients& gradients() {
  static const Gradients made = make_gradients();
  return made;
}

}  // namespace

HexPlaces straight_places(const std::vector<Vec3>& points, const Hex20& hex) {
  HexPlaces x;
  for (int c = 0; c < 8; ++c) x.col(c) = points[hex[c]];
  for (int e = 0; e < 12; ++e) x.col(8 + e) = (x.col(kHexEdges[e][0]) + x.col(kHexEdges[e][1])) / 2;
  return x;
}

HexPlaces curved_places(const std::vector<Vec3>& points, const Hex20& hex) {
  HexPlaces x;
  for (int i = 0; i < 20; ++i) x.col(i) = points[hex[i]];
  return x;
}

Determinants determinants(const HexPlaces& places) {
  const Eigen::Matrix<double, 3, 3 * kPoints> jacobians = places * gradients();
  Determinants result;
  for (Eigen::Index p = 0; p < kPoints; ++p) result[p] = jacobians.middleCols<3>(3 * p).determinant();
  return result;
}

Determinants determinants(const HexPlaces& places, int node, DeterminantSlopes& slopes) {
  const Eigen::Matrix<double, 3, 3 * kPoints> jacobians = places * gradients();
  Determinants result;
  for (Eigen::Index p = 0; p < kPoints; ++p) {
    const Vec3 r = jacobians.col(3 * p), s = jacobians.col(3 * p + 1), t = jacobians.col(3 * p + 2);
    const Vec3 cofactor = s.cross(t);
    result[p] = r.dot(cofactor);
    const auto gradient = gradients().row(node).segment<3>(3 * p);
    slopes.col(p) = cofactor * gradient[0] + t.cross(r) * gradient[1] + r.cross(s) * gradient[2];
  }
  return result;
}

}  // namespace polycube
