#include "label/divide.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/charts.h"
#include "label/straighten.h"
#include "label/tuning.h"

namespace polycube {
namespace {

// From the vertex to the middle of the face, in the frame.
Vec3 way_to_middle(const TetMesh& mesh, int face, const Vec3& vertex, const Mat3& frame) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_face[t] != face) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const double area = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm();
    sum += area * ((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3 - vertex);
  }
  return (frame * sum).normalized();
}

// Cuts that divide a face in pieces: positive and negative side of each.
struct Cutter {
  TetMesh& mesh;
  std::vector<int> region;  // per triangle: 8 * face + the sum of 2^i over the cuts i that it is on the positive side of

  void cut(int face, int i, const std::function<double(const Vec3&)>& value, const Monitor& monitor) {
    std::vector<BorderFunction> borders;
    borders.reserve(std::size_t{1} << i);
    for (int p = 0; p < 1 << i; ++p) borders.push_back({8 * face + p + (1 << i), 8 * face + p, [&](int n) { return value(mesh.points[n]); }});
    region = cut_along(mesh, region, borders, monitor);
  }
};

// Least and largest of the points of a face along a direction in the frame.
std::pair<double, double> extent_along(const TetMesh& mesh, int face, const Vec3& direction, const Mat3& frame) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_face[t] != face) continue;
    for (int n : mesh.triangles[t]) {
      low = std::min(low, direction.dot(frame * mesh.points[n]));
      high = std::max(high, direction.dot(frame * mesh.points[n]));
    }
  }
  return {low, high};
}

// `line`: what the quarters go round; `axis`: the axis of the frame that is next to it.
void divide(Cutter& cutter, int face, const Vec3& tip, const Vec3& line, const Vec3& axis, const Mat3& frame, const Monitor& monitor) {
  const TetMesh& mesh = cutter.mesh;
  const auto [low, high] = extent_along(mesh, face, axis, frame);
  const double half = (low + high) / 2, side = axis.dot(frame * tip) > half ? 1 : -1;
  int k = 0;
  axis.cwiseAbs().maxCoeff(&k);
  const Vec3 u = Vec3::Unit((k + 1) % 3), v = Vec3::Unit((k + 2) % 3);
  for (int i : {0, 1}) {
    const Vec3 normal = line.cross(u + (i == 0 ? 1 : -1) * v).normalized();
    cutter.cut(
        face, i, [&](const Vec3& p) { return normal.dot(frame * (p - tip)); }, monitor);
  }
  cutter.cut(
      face, 2, [&](const Vec3& p) { return side * (axis.dot(frame * p) - half); }, monitor);
}

// The label across `axis` that each quarter of the face turns to.
std::array<int, 4> quarter_labels(const Cutter& cutter, int face, const Vec3& axis, const Mat3& frame) {
  std::array<Vec3, 4> facing;
  facing.fill(Vec3::Zero());
  for (std::size_t t = 0; t < cutter.region.size(); ++t) {
    if (cutter.region[t] / 8 != face) continue;
    const auto& [a, b, c] = cutter.mesh.triangles[t];
    const std::vector<Vec3>& p = cutter.mesh.points;
    facing[cutter.region[t] % 4] += frame * (p[b] - p[a]).cross(p[c] - p[a]);
  }
  std::array<int, 4> labels{};
  for (int q = 0; q < 4; ++q) {
    const Vec3 n = facing[q] - axis.dot(facing[q]) * axis;
    int a = 0;
    n.cwiseAbs().maxCoeff(&a);
    labels[q] = 2 * a + (n[a] < 0);
  }
  return labels;
}

// Where two parts meet: away from the axis that neither of them faces.
Vec3 ray(const Vec3& normal, int axis) { return (normal[axis] < 0 ? 1 : -1) * (Vec3::Unit(axis) - normal[axis] * normal); }

// Shares of the extent across a face half way between places that follow each other, where they leave room.
std::vector<double> shares_between(const Vec3& across, const std::vector<Vec3>& places) {
  std::vector<double> at;
  at.reserve(places.size());
  for (const Vec3& p : places) at.push_back(across.dot(p));
  std::sort(at.begin(), at.end());
  std::vector<double> shares;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double extent = at.back() - at.front(), gap = at[i] - at[i - 1];
    if (gap > kLabelTuning.least_gap * extent && gap < (1 - kLabelTuning.least_gap) * extent) shares.push_back(((at[i] + at[i - 1]) / 2 - at.front()) / extent);
  }
  return shares;
}

}  // namespace

int third_at(const Vec3& normal, const Vec3& way) {
  int best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const int a = (k + 1) % 3, b = (k + 2) % 3;
    const double inside = std::min(third_side(normal, way, k, a), third_side(normal, way, k, b));
    if (inside > most) {
      most = inside;
      best = k;
    }
  }
  return best;
}

double third_side(const Vec3& normal, const Vec3& way, int part, int other) {
  const Vec3 border = normal.cross(ray(normal, 3 - part - other)).normalized();
  return border.dot(ray(normal, part)) < 0 ? border.dot(way) : -border.dot(way);
}

std::vector<FaceCut> plane_cuts(const Vec3& normal, const std::vector<Vec3>& vertices) {
  std::vector<FaceCut> cuts;
  if (normal.cwiseAbs().minCoeff() > kLabelTuning.least_share) cuts.push_back({.across = ray(normal, 0).normalized(), .thirds = true});
  for (int along = 0; along < 3; ++along) {
    // The line runs along one axis and divides the plane between the two others.
    if (std::abs(normal[(along + 1) % 3]) < kLabelTuning.least_share || std::abs(normal[(along + 2) % 3]) < kLabelTuning.least_share) continue;
    const Vec3 across = normal.cross(Vec3::Unit(along)).normalized();
    for (double share : {0.5, 0.35, 0.65}) cuts.push_back({.across = across, .share = share});
    for (double share : shares_between(across, vertices)) cuts.push_back({.across = across, .share = share, .exact = true});
  }
  return cuts;
}

std::vector<FaceCut> bent_cuts(const Vec3& mean, const Vec3& turning) {
  int own = 0;
  mean.cwiseAbs().maxCoeff(&own);
  const int k = turning[(own + 1) % 3] > turning[(own + 2) % 3] ? (own + 1) % 3 : (own + 2) % 3;
  std::vector<FaceCut> cuts;
  if (turning[k] < kLabelTuning.least_turn) return cuts;
  for (double share : kLabelTuning.bent_shares) cuts.push_back({.across = Vec3::Unit(k), .share = share});
  cuts.push_back({.across = Vec3::Unit(k), .share = kLabelTuning.bent_ends, .upper = 1 - kLabelTuning.bent_ends});
  return cuts;
}

std::vector<FaceCut> cone_cuts(const Vec3& axis, double along) {
  int k = 0;
  if (axis.cwiseAbs().maxCoeff(&k) < kLabelTuning.aligned_cosine) return {};
  if (std::abs(along) < kLabelTuning.least_share || std::abs(along) > kLabelTuning.flat_cosine) return {};
  return {{.across = Vec3::Unit(k), .level = ConePart::kUpper}, {.across = Vec3::Unit(k), .level = ConePart::kLower}};
}

double cut_middle(const TetMesh& mesh, int face, const FaceCut& cut, const Mat3& frame) {
  const auto [low, high] = extent_along(mesh, face, cut.across, frame);
  return low + cut.share * (high - low);
}

TetMesh cut_faces(TetMesh mesh, const std::vector<FaceCut>& cuts, const Mat3& frame, const Monitor& monitor) {
  Cutter cutter{mesh, mesh.triangle_face};
  for (int& r : cutter.region) r *= 8;
  for (std::size_t face = 1; face < cuts.size(); ++face) {
    const FaceCut& c = cuts[face];
    if (!c.exact) continue;
    const double middle = cut_middle(mesh, static_cast<int>(face), c, frame);
    cutter.cut(
        static_cast<int>(face), 0, [&](const Vec3& p) { return c.across.dot(frame * p) - middle; }, monitor);
  }
  return mesh;
}

Tips divide_tips(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const Monitor& monitor) {
  Tips tips;
  tips.axis.assign(static_cast<std::size_t>(model.face_count()) + 1, Vec3::Zero());
  tips.mesh = mesh;
  Cutter cutter{tips.mesh, mesh.triangle_face};
  for (int& r : cutter.region) r *= 8;
  for (const int e : model.edges()) {
    const CadEdge& edge = model.edge(e);
    const int face = edge.faces[0];
    if (!edge.tip || !tips.axis[face].isZero()) continue;
    const Vec3& tip = model.vertex(edge.vertices[0]);
    const bool cone = model.face(face).kind == SurfaceKind::kCone;
    const Vec3 line = cone ? Vec3(frame * model.face(face).axis) : way_to_middle(tips.mesh, face, tip, frame);
    int k = 0;
    line.cwiseAbs().maxCoeff(&k);
    tips.axis[face] = Vec3::Unit(k);
    tips.any = true;
    divide(cutter, face, tip, line, tips.axis[face], frame, monitor);
  }
  tips.label.assign(tips.mesh.triangles.size(), -1);
  tips.upper.assign(tips.mesh.triangles.size(), 0);
  for (const int f : model.faces()) {
    if (tips.axis[f].isZero()) continue;
    const std::array<int, 4> labels = quarter_labels(cutter, f, tips.axis[f], frame);
    for (std::size_t t = 0; t < cutter.region.size(); ++t) {
      if (cutter.region[t] / 8 != f) continue;
      tips.label[t] = labels[cutter.region[t] % 4];
      tips.upper[t] = cutter.region[t] % 8 >= 4;
    }
  }
  return tips;
}

}  // namespace polycube
