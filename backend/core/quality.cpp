#include "core/quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/hexahedron.h"

namespace polycube {

namespace {

// Of a corner's trilinear shape function on [-1, 1]^3.
Vec3 shape_gradient(int corner, const Vec3& at) {
  const auto& c = kCornerCoordinates[corner];
  const Vec3 r(2 * c[0] - 1, 2 * c[1] - 1, 2 * c[2] - 1);
  const Vec3 s = Vec3::Ones() + r.cwiseProduct(at);
  return {r[0] * s[1] * s[2] / 8, s[0] * r[1] * s[2] / 8, s[0] * s[1] * r[2] / 8};
}

// Of the trilinear map from [-1, 1]^3.
Mat3 jacobian(const std::vector<Vec3>& points, const Hex& hex, const Vec3& at) {
  Mat3 jacobian = Mat3::Zero();
  for (int i = 0; i < 8; ++i) jacobian += points[hex[i]] * shape_gradient(i, at).transpose();
  return jacobian;
}

}  // namespace

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

double edge_ratio(const std::vector<Vec3>& points, const Hex& hex) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const auto& [a, b] : kHexEdges) {
    const double length = (points[hex[b]] - points[hex[a]]).norm();
    least = std::min(least, length);
    most = std::max(most, length);
  }
  return least > 0 ? most / least : std::numeric_limits<double>::infinity();
}

double skew(const std::vector<Vec3>& points, const Hex& hex) {
  std::array<Vec3, 3> axes;
  for (int d = 0; d < 3; ++d) {
    axes[d] = Vec3::Zero();
    for (int c = 0; c < 8; ++c) axes[d] += (2 * kCornerCoordinates[c][d] - 1) * points[hex[c]];
    const double length = axes[d].norm();
    if (!(length > 0)) return 1;
    axes[d] /= length;
  }
  return std::min(1.0, std::max({std::abs(axes[0].dot(axes[1])), std::abs(axes[1].dot(axes[2])), std::abs(axes[2].dot(axes[0]))}));
}

double warpage(const std::vector<Vec3>& points, const Hex& hex) {
  double worst = 0;
  for (const auto& face : kHexFaces) {
    std::array<Vec3, 4> normals;
    for (int k = 0; k < 4; ++k) {
      const Vec3& at = points[hex[face[k]]];
      normals[k] = (points[hex[face[(k + 1) % 4]]] - at).cross(points[hex[face[(k + 3) % 4]]] - at);
      const double length = normals[k].norm();
      normals[k] = length > 0 ? Vec3(normals[k] / length) : Vec3::Zero();
    }
    const double across = std::min(normals[0].dot(normals[2]), normals[1].dot(normals[3]));
    worst = std::max(worst, 1 - across * across * across);
  }
  return worst;
}

namespace {

class SpreadOf {
 public:
  void add(double value) {
    spread_.min = count_ == 0 ? value : std::min(spread_.min, value);
    spread_.max = count_ == 0 ? value : std::max(spread_.max, value);
    spread_.mean += value;
    ++count_;
  }
  Spread get() const { return {spread_.min, count_ > 0 ? spread_.mean / count_ : 0.0, spread_.max}; }

 private:
  Spread spread_;  // mean: the sum
  double count_ = 0;
};

}  // namespace

ShapeSummary summarise_shape(const HexMesh& mesh) {
  SpreadOf ratio, skewness, warp;
  for (const Hex& h : mesh.hexes) {
    ratio.add(edge_ratio(mesh.points, h));
    skewness.add(skew(mesh.points, h));
    warp.add(warpage(mesh.points, h));
  }
  return {ratio.get(), skewness.get(), warp.get()};
}

const std::array<InnerDerivatives, 3>& inner_derivatives() {
  static const std::array<InnerDerivatives, 3> table = [] {
    std::array<InnerDerivatives, 3> result;
    const double g = std::sqrt(0.6);
    for (int p = 0; p < kInnerPoints; ++p) {
      const int i = p / 9, j = p / 3 % 3, k = p % 3;
      const Vec3 at(g * (i - 1), g * (j - 1), g * (k - 1));
      for (int c = 0; c < 8; ++c) {
        const Vec3 gradient = shape_gradient(c, at);
        for (int a = 0; a < 3; ++a) result[a](p, c) = gradient[a];
      }
    }
    return result;
  }();
  return table;
}

double least_inner_determinant(const std::vector<Vec3>& points, const Hex& hex) {
  Eigen::Matrix<double, 8, 3> corners;
  for (int c = 0; c < 8; ++c) corners.row(c) = points[hex[c]].transpose();
  std::array<Eigen::Matrix<double, kInnerPoints, 3>, 3> j;
  for (int a = 0; a < 3; ++a) j[a].noalias() = inner_derivatives()[a] * corners;
  const auto product = [&](int k, int l, int m) {
    return j[0].col(k).array() * (j[1].col(l).array() * j[2].col(m).array() - j[1].col(m).array() * j[2].col(l).array());
  };
  return (product(0, 1, 2) + product(1, 2, 0) + product(2, 0, 1)).minCoeff();
}

double hex_volume(const std::vector<Vec3>& points, const Hex& hex) {
  const double g = 1 / std::sqrt(3.0);
  double volume = 0;
  for (const auto& at : kCornerCoordinates) {
    volume += jacobian(points, hex, {g * (2 * at[0] - 1), g * (2 * at[1] - 1), g * (2 * at[2] - 1)}).determinant();
  }
  return volume;
}

}  // namespace polycube
