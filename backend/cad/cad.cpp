#include "cad/cad.h"

#include <BRepTools.hxx>
#include <Standard_Failure.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "cad/occt.h"
#include "cad/shape.h"
#include "core/error.h"

namespace polycube {
namespace {

std::shared_ptr<const CadModel::Shape> checked(const FileShape& read, bool sew, const Monitor& monitor) {
  return described(find_solid(read, sew, monitor), read.warnings, monitor);
}

}  // namespace

std::shared_ptr<const CadModel::Shape> described(const FoundSolid& found, const std::vector<std::string>& reading, const Monitor& monitor) {
  try {
    const auto shape = catching_faults([&] { return describe(found.solid, found.numbers, monitor); });
    shape->warnings = reading;
    shape->warnings.insert(shape->warnings.end(), found.warnings.begin(), found.warnings.end());
    return shape;
  } catch (const Standard_Failure& failure) {
    throw InvalidInput("OpenCASCADE cannot evaluate the shape: " + reason_of(failure));
  }
}

CadModel CadModel::read(const std::string& path, const ReadOptions& options, const Monitor& monitor) {
  const FileShape shape = read_shape(path, options, monitor);
  try {
    return CadModel(checked(shape, options.sew, monitor));
  } catch (const InvalidInput& error) {
    throw InvalidInput(path + ": " + error.what());
  }
}

CadModel CadModel::from_brep(const std::string& text, const ReadOptions& options, const Monitor& monitor) {
  return CadModel(checked(parse_brep(text, monitor), options.sew, monitor));
}

const std::vector<std::string>& CadModel::warnings() const { return shape_->warnings; }

std::string CadModel::to_brep() const {
  std::ostringstream stream;
  BRepTools::Write(shape_->shape, stream, false, false, TopTools_FormatVersion_VERSION_1);
  return stream.str();
}

const std::vector<int>& CadModel::brep_order(int dim) const { return shape_->numbers.at(static_cast<std::size_t>(dim)); }
const std::vector<int>& CadModel::faces() const { return shape_->ascending[2]; }
const std::vector<int>& CadModel::edges() const { return shape_->ascending[1]; }
const std::vector<int>& CadModel::vertices() const { return shape_->ascending[0]; }
int CadModel::face_count() const { return static_cast<int>(shape_->faces.size()); }
int CadModel::edge_count() const { return static_cast<int>(shape_->edges.size()); }
int CadModel::vertex_count() const { return static_cast<int>(shape_->vertices.size()); }
const CadFace& CadModel::face(int id) const { return shape_->faces.at(static_cast<std::size_t>(id - 1)); }
const CadEdge& CadModel::edge(int id) const { return shape_->edges.at(static_cast<std::size_t>(id - 1)); }
const Vec3& CadModel::vertex(int id) const { return shape_->vertices.at(static_cast<std::size_t>(id - 1)); }

Vec3 CadModel::box_min() const { return shape_->box.min(); }
Vec3 CadModel::box_max() const { return shape_->box.max(); }
double CadModel::diagonal() const { return shape_->box.diagonal().norm(); }
double CadModel::volume() const { return shape_->volume; }

int CadModel::euler_characteristic() const {
  // A face cut open along its seams is a disk with one hole for each part of its border but the first: a hole that touches the rest of the border leaves no
  // ring.
  int result = static_cast<int>(vertices().size() + faces().size());
  for (const int e : edges()) result -= edge(e).degenerate ? 0 : 1;
  for (const int f : faces()) result -= std::max(0, shape_->face(f).border_parts - 1);
  return result;
}

FacePoint CadModel::project_to_face(int id, const Vec3& p, const Vec2* seed) const {
  const FaceGeometry& face = shape_->face(id);
  FacePoint best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto try_foot = [&](const Vec2& start) {
    bool converged = false;
    const Vec2 uv = foot_on_surface(face, p, start, &converged);
    if (!converged || !inside(*shape_, face, uv)) return false;
    const Vec3 point = face_point(id, uv);
    const double distance = (point - p).norm();
    if (distance < best.distance) best = {point, uv, distance};
    return true;
  };
  if (seed || face.samples.empty()) {
    if (try_foot(seed ? *seed : Vec2::Zero())) return best;
  }
  if (!face.samples.empty()) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < face.samples.size(); ++i) {
      const double distance = (face.samples[i] - p).squaredNorm();
      if (distance < least) least = distance, nearest = i;
    }
    // A foot point farther away than the sample means that Newton's method left the valley it started in.
    if (try_foot(face.sample_uv[nearest]) && best.distance <= std::sqrt(least) * (1 + 1e-9)) return best;
    if (std::sqrt(least) < best.distance) best = {face.samples[nearest], face.sample_uv[nearest], std::sqrt(least)};
  }
  for (const Vec2& uv : face.tips) {
    const Vec3 point = face_point(id, uv);
    if ((point - p).norm() < best.distance) best = {point, uv, (point - p).norm()};
  }
  int border_edge = 0;
  double border_t = 0;
  for (const int e : face.border_edges) {
    const EdgeGeometry& edge = shape_->edge(e);
    if (edge.box.exteriorDistance(p) >= best.distance) continue;
    const EdgePoint candidate = nearest_on_edge(edge, p, nullptr);
    if (candidate.distance >= best.distance) continue;
    best.point = candidate.point;
    best.distance = candidate.distance;
    border_edge = e;
    border_t = candidate.t;
  }
  if (border_edge == 0) {
    if (std::isfinite(best.distance)) return best;
    // A face without a border in space (whole sphere, torus): its foot point did not converge, any pole serves.
    const Vec2 uv = wrap(face, foot_on_surface(face, p, face.domain.center(), nullptr));
    const Vec3 point = face_point(id, uv);
    return {point, uv, (point - p).norm()};
  }
  if (face.closed_form.index() != 0) {
    best.uv = foot_on_surface(face, best.point, Vec2::Zero(), nullptr);
  } else {
    for (const EdgeUse& use : shape_->edge(border_edge).uses) {
      if (use.face != id) continue;
      const gp_Pnt2d uv = use.curve->Value(border_t);
      best.uv = {uv.X(), uv.Y()};
    }
  }
  return best;
}

EdgePoint CadModel::project_to_edge(int id, const Vec3& p, const double* seed) const {
  const EdgeGeometry& edge = shape_->edge(id);
  if (edge.curve.IsNull()) {
    const Vec3& point = vertex(this->edge(id).vertices[0]);
    return {point, edge.first, (point - p).norm()};
  }
  return nearest_on_edge(edge, p, seed);
}

Vec3 CadModel::face_normal(int id, const Vec2& uv) const {
  const FaceGeometry& face = shape_->face(id);
  return face.sign * surface_normal(face, uv);
}

Vec3 CadModel::vertex_normal(int face, int vertex) const {
  return shape_->vertex_normals.get({face, vertex}, [&] { return face_normal(face, project_to_face(face, this->vertex(vertex)).uv); });
}

Mat3 CadModel::face_bend(int id, const Vec2& uv) const {
  const FaceGeometry& face = shape_->face(id);
  gp_Pnt p;
  gp_Vec d1u, d1v, d2u, d2v, d2uv;
  Vec2 at = uv;
  Vec3 u, v, normal;
  for (int attempt = 0;; ++attempt) {
    face.surface->D2(at[0], at[1], p, d1u, d1v, d2u, d2v, d2uv);
    u = to_vec(d1u);
    v = to_vec(d1v);
    normal = u.cross(v);
    if (normal.norm() > 1e-6 * std::max(u.squaredNorm(), v.squaredNorm())) break;
    if (attempt == 4) return Mat3::Zero();
    // A pole or a collapsed border: as a little inside the face.
    at = uv + std::pow(10.0, attempt - 4) * (Vec2(face.domain.center()) - uv);
  }
  // Rows that take a tangent vector to its u and v.
  const Vec3 to_u = v.cross(normal) / normal.squaredNorm(), to_v = normal.cross(u) / normal.squaredNorm();
  const Vec3 n = face.sign * normal.normalized();
  const Mat3 bend = n.dot(to_vec(d2u)) * to_u * to_u.transpose() + n.dot(to_vec(d2v)) * to_v * to_v.transpose() +
                    n.dot(to_vec(d2uv)) * (to_u * to_v.transpose() + to_v * to_u.transpose());
  const Vec3 here = surface_normal(face, uv);
  const Mat3 onto = Mat3::Identity() - here * here.transpose();
  return onto * bend * onto;
}

Vec3 CadModel::face_point(int id, const Vec2& uv) const { return to_vec(shape_->face(id).surface->Value(uv[0], uv[1])); }

Vec3 CadModel::edge_point(int id, double t) const {
  const EdgeGeometry& edge = shape_->edge(id);
  return edge.curve.IsNull() ? vertex(this->edge(id).vertices[0]) : to_vec(edge.curve->Value(t));
}

Vec3 CadModel::edge_bend(int id, double t) const {
  const EdgeGeometry& edge = shape_->edge(id);
  if (edge.curve.IsNull()) return Vec3::Zero();
  gp_Pnt point;
  gp_Vec d1, d2;
  edge.curve->D2(t, point, d1, d2);
  if (!(d1.Magnitude() > 1e-12 * (1 + d2.Magnitude()))) return Vec3::Zero();
  const Vec3 slope = to_vec(d1), second = to_vec(d2);
  return (second - slope * (slope.dot(second) / slope.squaredNorm())) / slope.squaredNorm();
}

Vec3 CadModel::edge_tangent(int id, double t) const {
  const EdgeGeometry& edge = shape_->edge(id);
  if (edge.curve.IsNull()) return Vec3::Zero();
  gp_Pnt point;
  gp_Vec d1, d2;
  edge.curve->D2(t, point, d1, d2);
  if (d1.Magnitude() > 1e-12 * (1 + d2.Magnitude())) return to_vec(d1).normalized();
  // A cusp, or a spline with a double pole at its end: the chord into the edge shows the way.
  const double step = 1e-4 * (edge.last - edge.first);
  const double from = std::max(edge.first, t - step), to = std::min(edge.last, t + step);
  return (to_vec(edge.curve->Value(to)) - to_vec(edge.curve->Value(from))).normalized();
}

std::array<double, 2> CadModel::edge_range(int id) const { return {shape_->edge(id).first, shape_->edge(id).last}; }

std::vector<Vec3> CadModel::edge_samples(int id, int count) const {
  const auto [first, last] = edge_range(id);
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) points.push_back(edge_point(id, first + (last - first) * i / (count - 1)));
  return points;
}

}  // namespace polycube
