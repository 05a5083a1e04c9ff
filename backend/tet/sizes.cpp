#include "tet/sizes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tet/tuning.h"

namespace polycube {
namespace {

double quantile(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(kTetTuning.quantile * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

/// Curvature of the circle through three points, 1/mm.
double circle_curvature(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double product = (b - a).norm() * (c - b).norm() * (a - c).norm();
  return product > 0 ? 2 * (b - a).cross(c - a).norm() / product : 0;
}

double edge_curvature(const CadModel& model, int id) {
  const std::vector<Vec3> points = model.edge_samples(id, kTetTuning.samples);
  std::vector<double> curvature;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) curvature.push_back(circle_curvature(points[i - 1], points[i], points[i + 1]));
  return quantile(curvature);
}

/// From how fast the normal turns along the border.
double face_curvature(const CadModel& model, int id) {
  const CadFace& face = model.face(id);
  if (face.kind == SurfaceKind::kPlane) return 0;
  if (face.kind == SurfaceKind::kCylinder || face.kind == SurfaceKind::kSphere || face.kind == SurfaceKind::kTorus) return 1 / face.radius;
  std::vector<double> curvature;
  for (const int edge : face.edges)
    for (const Vec3& p : model.edge_samples(edge, kTetTuning.samples)) {
      const Vec2 uv = model.project_to_face(id, p).uv;
      const Vec3 point = model.face_point(id, uv), normal = model.face_normal(id, uv);
      double largest = 0;
      for (int k = 0; k < 2; ++k) {
        // A step of known length in space, whatever the parametrisation.
        Vec2 next = uv;
        next[k] += kTetTuning.parameter_step;
        const double speed = (model.face_point(id, next) - point).norm() / kTetTuning.parameter_step;
        if (speed == 0) continue;
        next[k] = uv[k] + kTetTuning.step * model.diagonal() / speed;
        const double way = (model.face_point(id, next) - point).norm();
        if (way > 0) largest = std::max(largest, (model.face_normal(id, next) - normal).norm() / way);
      }
      curvature.push_back(largest);
    }
  return quantile(curvature);
}

}  // namespace

EntitySizes entity_sizes(const CadModel& model, double size, double per_circle) {
  EntitySizes sizes;
  const double finest = size / kTetTuning.finest;
  const auto from_curvature = [&](double curvature, double least) {
    if (per_circle <= 0 || curvature <= 0) return size;
    return std::clamp(2 * std::numbers::pi / (per_circle * curvature), least, size);
  };
  double surface = 0;
  for (const int f : model.faces()) surface += model.face(f).area;
  std::vector<double> by_number(static_cast<std::size_t>(model.face_count()) + 1, size);
  for (const int f : model.brep_order(2)) {
    const double area = model.face(f).area;
    const double least = area < kTetTuning.main_face * surface ? finest : std::min(finest, std::sqrt(area / kTetTuning.main_triangles));
    sizes.faces.push_back(from_curvature(face_curvature(model, f), least));
    by_number[static_cast<std::size_t>(f)] = sizes.faces.back();
  }
  for (const int e : model.brep_order(1)) {
    const CadEdge& edge = model.edge(e);
    double edge_size = edge.degenerate ? size : from_curvature(edge_curvature(model, e), finest);
    for (const int f : edge.faces) edge_size = std::min(edge_size, by_number[static_cast<std::size_t>(f)]);
    sizes.edges.push_back(edge_size);
  }
  sizes.least = std::min(finest, *std::min_element(sizes.faces.begin(), sizes.faces.end()));
  return sizes;
}

}  // namespace polycube
