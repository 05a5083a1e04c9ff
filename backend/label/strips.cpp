#include "label/strips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "core/charts.h"
#include "label/graph_cut.h"
#include "label/straighten.h"
#include "label/tuning.h"

namespace polycube {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

int label_of(const Vec3& n) {
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (n[axis] < 0);
}

class Barrel {
 public:
  Barrel(const CadModel& model, const Mat3& frame, int face) : centre_(model.face(face).centre), frame_(frame) {
    across_[0] = model.face(face).axis.unitOrthogonal();
    across_[1] = model.face(face).axis.cross(across_[0]);
  }
  double angle(const Vec3& p) const { return std::atan2((p - centre_).dot(across_[1]), (p - centre_).dot(across_[0])); }
  Vec3 direction(double angle) const { return std::cos(angle) * across_[0] + std::sin(angle) * across_[1]; }
  // The label nearest to the direction, and by how much it is nearer than the second, radians.
  std::pair<int, double> label(double angle) const {
    const Vec3 n = frame_ * direction(angle);
    Vec3 by_size = n.cwiseAbs();
    std::sort(by_size.data(), by_size.data() + 3);
    return {label_of(n), 2 * std::atan2(by_size[2], by_size[1]) - std::numbers::pi / 2};
  }

 private:
  Vec3 centre_;
  const Mat3& frame_;
  std::array<Vec3, 2> across_;
};

// Angles on the barrel along an edge, without jumps.
std::vector<double> course(const CadModel& model, const Barrel& barrel, int edge) {
  std::vector<double> angles;
  for (const Vec3& p : model.edge_samples(edge, kLabelTuning.samples)) {
    const double a = barrel.angle(p);
    angles.push_back(angles.empty() ? a : angles.back() + std::remainder(a - angles.back(), 2 * std::numbers::pi));
  }
  return angles;
}

// The strip beside the place at `angle` whose edges are on its lower (`side` 1) or upper (-1) side.
std::optional<Strip> strip_beside(const Barrel& barrel, int face, double angle, double side, double room) {
  double way = kLabelTuning.close * room;
  while (way > -kLabelTuning.beyond && barrel.label(angle + side * way).second > 2 * kDegree) way -= kDegree;
  double near = angle + side * (way - kLabelTuning.line_step), far = angle + side * (way + kLabelTuning.line_step);
  const int label = barrel.label(near).first;
  if (way <= -kLabelTuning.beyond || barrel.label(far).first == label) return std::nullopt;
  for (int i = 0; i < kLabelTuning.bisections; ++i) {
    const double middle = (near + far) / 2;
    (barrel.label(middle).first == label ? near : far) = middle;
  }
  return Strip{face, {barrel.direction((near + far) / 2), barrel.direction(angle + side * room)}, label};
}

// The side of an edge along a generator, 1 towards larger and -1 towards smaller angles, on which the barrel is only beyond the edge's ends, as in the gap
// beside a claw; 0 for none.
double gap_side(const CadModel& model, int face, int edge) {
  const CadFace& barrel = model.face(face);
  const std::vector<Vec3> along = model.edge_samples(edge, 3);
  const double step = kLabelTuning.beside * (along[1] - barrel.centre).cross(barrel.axis).norm();
  const auto is_on = [&](const Vec3& at, double side) {
    const Vec3 p = barrel.centre + Eigen::AngleAxisd(side * kLabelTuning.beside, barrel.axis) * (at - barrel.centre);
    return model.project_to_face(face, p).distance < kLabelTuning.on_barrel * step;
  };
  const auto goes_on = [&](const Vec3& end, double side) { return is_on(end + step * (end - along[1]).normalized(), side); };
  for (const double side : {1.0, -1.0}) {
    if (is_on(along[1], -side) && !is_on(along[1], side) && (goes_on(along.front(), side) || goes_on(along.back(), side))) return side;
  }
  return 0;
}

// Where the label at `angle` ends towards `side`; none within a right angle.
std::optional<double> line_beyond(const Barrel& barrel, double angle, double side) {
  const int label = barrel.label(angle).first;
  double near = angle, far = angle;
  while (barrel.label(far).first == label) {
    near = far;
    far += side * kDegree;
    if (std::abs(far - angle) > std::numbers::pi / 2) return std::nullopt;
  }
  for (int i = 0; i < kLabelTuning.bisections; ++i) {
    const double middle = (near + far) / 2;
    (barrel.label(middle).first == label ? near : far) = middle;
  }
  return (near + far) / 2;
}

// A face across the barrel that an arc of it and one other edge bound has two corners, and needs four: where the arc has one label both of its ends take the
// next ones.
std::vector<Strip> strips_of_segment(const CadModel& model, const Barrel& barrel, int face, int segment) {
  int chord = 0, others = 0;
  std::vector<double> arc;
  for (const int e : model.face(segment).edges) {
    const CadEdge& edge = model.edge(e);
    if (edge.faces[0] == face || edge.faces[1] == face) {
      const std::vector<double> angles = course(model, barrel, e);
      arc.insert(arc.end(), angles.begin(), angles.end());
    } else {
      chord = e;
      ++others;
    }
  }
  if (others != 1 || arc.empty()) return {};
  const auto& [from, to] = model.edge(chord).vertices;
  const double middle = barrel.angle((model.vertex(from) + model.vertex(to)) / 2);
  double half = 0;
  for (const double a : arc) half = std::max(half, std::abs(std::remainder(a - middle, 2 * std::numbers::pi)));
  if (half < kLabelTuning.least_segment || half > std::numbers::pi / 4) return {};
  std::vector<Strip> strips;
  for (const double side : {1.0, -1.0}) {
    const double end = middle + side * half;
    const auto line = barrel.label(end).first == barrel.label(middle).first ? line_beyond(barrel, end, side) : std::nullopt;
    if (line) strips.push_back({face, {barrel.direction(*line), barrel.direction(middle + side * half / 2)}, barrel.label(*line + side * kDegree).first});
  }
  return strips;
}

// Is the direction in the strip?
bool within(const Strip& s, const Vec3& arm) {
  return s.generator[0].cross(arm).dot(arm.cross(s.generator[1])) > 0 && arm.dot(s.generator[0] + s.generator[1]) > 0;
}

Vec3 arm_to(const CadFace& face, const Vec3& p) { return p - face.centre - (p - face.centre).dot(face.axis) * face.axis; }

Vec3 middle_of(const TetMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3;
}

}  // namespace

std::vector<Strip> find_strips(const CadModel& model, const Mat3& frame, int face, double size) {
  const Barrel barrel(model, frame, face);
  const double radius = model.face(face).radius;
  const double room =
      radius > 0 ? std::clamp(kLabelTuning.room_triangles * size / radius, kLabelTuning.least_room, kLabelTuning.most_room) : kLabelTuning.least_room;
  std::vector<Strip> strips;
  std::set<int> beside;
  std::map<std::pair<int, double>, int> ends;  // (vertex, side) -> edges that are furthest on that side there
  const auto add = [&](double angle, double side) {
    if (const auto strip = strip_beside(barrel, face, angle, side, room)) strips.push_back(*strip);
  };
  for (int e : model.face(face).edges) {
    const CadEdge& edge = model.edge(e);
    if (edge.seam || edge.degenerate) continue;
    const int other = edge.faces[edge.faces[0] == face ? 1 : 0];
    if (model.face(other).kind == SurfaceKind::kPlane && beside.insert(other).second) {
      for (const Strip& s : strips_of_segment(model, barrel, face, other)) strips.push_back(s);
    }
    const std::vector<double> angles = course(model, barrel, e);
    const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
    if (*most - *least < kLabelTuning.straight) {
      // Only where the border would run on along the edge: a side further off is in nobody's way.
      const double to_line = std::abs(barrel.label(*least).second) / 2;
      const double side = to_line < kLabelTuning.near_generators ? gap_side(model, face, e) : 0;
      if (side != 0) add(side > 0 ? *most : *least, side);
      continue;
    }
    if (std::abs(angles.back() - angles.front()) > std::numbers::pi) continue;
    for (const auto& [furthest, side] : {std::pair(most, 1.0), std::pair(least, -1.0)}) {
      const bool at_end = furthest == angles.begin() || furthest + 1 == angles.end();
      // At a vertex the next edge has to turn back too.
      if (edge.closed || !at_end || ++ends[{edge.vertices[furthest == angles.begin() ? 0 : 1], side}] == 2) add(*furthest, side);
    }
  }
  return strips;
}

bool Room::on(int face) const {
  return std::any_of(strips.begin(), strips.end(), [&](const Strip& s) { return s.face == face; });
}

Room make_room(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const std::vector<char>& divided, const Monitor& monitor) {
  Room room;
  double size = 0;
  for (const Triangle& t : mesh.triangles) size += (mesh.points[t[0]] - mesh.points[t[1]]).norm() / static_cast<double>(mesh.triangles.size());
  for (const int f : model.faces()) {
    const SurfaceKind kind = model.face(f).kind;
    if (!divided[f] || (kind != SurfaceKind::kCylinder && kind != SurfaceKind::kCone)) continue;
    const std::vector<Strip> found = find_strips(model, frame, f, size);
    room.strips.insert(room.strips.end(), found.begin(), found.end());
  }
  if (room.strips.empty()) return room;
  room.mesh = mesh;
  std::vector<int> side;  // two for each CAD face; which one a triangle is on matters to the cutting only
  for (int f : mesh.triangle_face) side.push_back(2 * f);
  std::vector<BorderFunction> borders;
  for (const Strip& s : room.strips) {
    for (const Vec3& generator : s.generator) {
      const CadFace& face = model.face(s.face);
      borders.push_back({2 * s.face + 1, 2 * s.face, [&room, &face, generator](int n) {
                           const Vec3 arm = arm_to(face, room.mesh.points[n]);
                           return arm.dot(generator) > 0 ? face.axis.cross(generator).dot(arm) : kNoOpinion;
                         }});
    }
  }
  cut_along(room.mesh, side, borders, monitor);
  return room;
}

void settle_lines(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const Room& room, std::vector<int>& label) {
  for (std::size_t t = 0; t < label.size(); ++t) {
    for (const Strip& s : room.strips) {
      if (s.face != mesh.triangle_face[t]) continue;
      const Vec3 arm = arm_to(model.face(s.face), middle_of(mesh, static_cast<int>(t)));
      const Vec3 mirrored = 2 * arm.dot(s.generator[0]) * s.generator[0] - arm;
      if (!within(s, arm) && !within(s, mirrored)) continue;
      const int nearest = label_of(frame * arm), other = label_of(frame * mirrored);
      if (label[t] == other) label[t] = nearest;
    }
  }
}

void give_strips(const CadModel& model, const TetMesh& mesh, const Room& room, RegionGraph& graph, std::vector<int>& label) {
  for (std::size_t r = 0; r < label.size(); ++r) {
    Region& region = graph.regions[r];
    Vec3 centre = Vec3::Zero();
    for (int t : region.triangles) centre += middle_of(mesh, t) / static_cast<double>(region.triangles.size());
    for (const Strip& s : room.strips) {
      if (s.face != region.face || s.label == label[r] || region.data[s.label] >= kForbidden) continue;
      if (!within(s, arm_to(model.face(s.face), centre))) continue;
      std::swap(region.data[s.label], region.data[label[r]]);
      label[r] = s.label;
    }
  }
}

}  // namespace polycube
