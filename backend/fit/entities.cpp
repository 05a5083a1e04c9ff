#include "fit/entities.h"

#include <limits>

#include "core/parallel.h"

namespace polycube {

Entities::Entities(const CadModel& model, const Association& association, int threads) : model_(model), association_(association), threads_(threads) {
  const std::size_t nodes = association.point_cad.size();
  seeds_.assign(nodes, Vec2::Zero());
  seeded_.assign(nodes, 0);
  faces_.assign(nodes, 0);
  frames_.assign(nodes, Vec3::Zero());
  bends_.assign(nodes, Mat3::Zero());
  for (std::size_t v = 0; v < nodes; ++v) {
    if (association.point_cad[v].dim < 3) boundary_.push_back(static_cast<int>(v));
  }
}

Vec3 Entities::project(int node, const Vec3& p) {
  const CadRef& entity = cad(node);
  if (entity.dim == 3) return p;
  if (entity.dim == 0) return model_.vertex(entity.id);
  if (entity.dim == 1) {
    const double seed = seeds_[node][0];
    const EdgePoint found = model_.project_to_edge(entity.id, p, seeded_[node] ? &seed : nullptr);
    set_edge_parameter(node, found.t);
    frames_[node] = model_.edge_tangent(entity.id, found.t);
    bends_[node].col(0) = model_.edge_bend(entity.id, found.t);
    return found.point;
  }
  FacePoint best;
  int face = 0;
  best.distance = std::numeric_limits<double>::infinity();
  for (int id : association_.patches[entity.id]) {
    const Vec2 seed = seeds_[node];
    const FacePoint found = model_.project_to_face(id, p, faces_[node] == id ? &seed : nullptr);
    if (found.distance < best.distance) {
      best = found;
      face = id;
    }
  }
  faces_[node] = face;
  seeds_[node] = best.uv;
  frames_[node] = model_.face_normal(face, best.uv);
  bends_[node] = model_.face_bend(face, best.uv);
  return best.point;
}

void Entities::project(std::vector<Vec3>& points, const std::vector<int>* nodes) {
  const std::vector<int>& list = nodes ? *nodes : boundary_;
  for_chunks(static_cast<int>(list.size()), 64, threads_, [&](int, int first, int last) {
    for (int i = first; i < last; ++i) points[list[i]] = project(list[i], points[list[i]]);
  });
}

double Entities::distance(int node, const Vec3& p) const {
  const CadRef& entity = cad(node);
  if (entity.dim == 0) return (model_.vertex(entity.id) - p).norm();
  if (entity.dim == 1) return model_.project_to_edge(entity.id, p).distance;
  double least = std::numeric_limits<double>::infinity();
  for (int id : entity.dim == 2 ? association_.patches[entity.id] : std::vector<int>{}) least = std::min(least, model_.project_to_face(id, p).distance);
  return entity.dim == 2 ? least : 0;
}

Vec3 Entities::bent(int node, const Vec3& step) const {
  switch (dimension(node)) {
    case 0:
      return Vec3::Zero();
    case 1:
      return step + step.squaredNorm() / 2 * bends_[node].col(0);
    case 2:
      return step + step.dot(bends_[node] * step) / 2 * frames_[node];
    default:
      return step;
  }
}

Vec3 Entities::along(int node, const Vec3& gradient, const Vec3& step) const {
  const Vec3& f = frames_[node];
  switch (dimension(node)) {
    case 0:
      return Vec3::Zero();
    case 1:
      return f * f.dot(gradient) + step * bends_[node].col(0).dot(gradient);
    case 2:
      return gradient + f.dot(gradient) * (bends_[node] * step - f);
    default:
      return gradient;
  }
}

double Entities::turned(int node, const Vec3& step) const {
  switch (dimension(node)) {
    case 1:
      return bends_[node].col(0).norm() * step.norm();
    case 2:
      return (bends_[node] * step).norm();
    default:
      return 0;
  }
}

}  // namespace polycube
