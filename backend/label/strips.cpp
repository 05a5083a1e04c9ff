#include "label/strips.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/charts.h"
#include "label/graph_cut.h"

namespace polycube {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Room beside an edge: this many triangles, within these bounds.
constexpr double kTriangles = 2;
constexpr double kLeastRoom = 10 * kDegree, kMostRoom = 25 * kDegree;
// Share of the room within which the line at 45 degrees is too close.
constexpr double kClose = 0.5;
// An edge this far beyond the line at 45 degrees still belongs to the side it comes from.
constexpr double kBeyond = 30 * kDegree;
// An edge that spans less runs along the barrel.
constexpr double kStraight = 5 * kDegree;
constexpr int kSamples = 65;

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
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    return {2 * axis + (n[axis] < 0), 2 * std::atan2(by_size[2], by_size[1]) - std::numbers::pi / 2};
  }

 private:
  Vec3 centre_;
  const Mat3& frame_;
  std::array<Vec3, 2> across_;
};

// Angles on the barrel along an edge, without jumps.
std::vector<double> course(const CadModel& model, const Barrel& barrel, int edge) {
  std::vector<double> angles;
  for (const Vec3& p : model.edge_samples(edge, kSamples)) {
    const double a = barrel.angle(p);
    angles.push_back(angles.empty() ? a : angles.back() + std::remainder(a - angles.back(), 2 * std::numbers::pi));
  }
  return angles;
}

// The strip beside the place at `angle` whose edges are on its lower (`side` 1) or upper (-1) side.
std::optional<Strip> strip_beside(const Barrel& barrel, int face, double angle, double side, double room) {
  double diagonal = kClose * room;
  while (diagonal > -kBeyond && barrel.label(angle + side * diagonal).second > 2 * kDegree) diagonal -= kDegree;
  if (diagonal <= -kBeyond) return std::nullopt;
  return Strip{face, {barrel.direction(angle + side * diagonal), barrel.direction(angle + side * room)}, barrel.label(angle + side * (diagonal - 3 * kDegree)).first};
}

}  // namespace

std::vector<Strip> find_strips(const CadModel& model, const Mat3& frame, int face, double size) {
  const Barrel barrel(model, frame, face);
  const double radius = model.face(face).radius;
  const double room = radius > 0 ? std::clamp(kTriangles * size / radius, kLeastRoom, kMostRoom) : kLeastRoom;
  std::vector<Strip> strips;
  std::map<std::pair<int, double>, int> ends;  // (vertex, side) -> edges that are furthest on that side there
  const auto add = [&](double angle, double side) {
    if (const auto strip = strip_beside(barrel, face, angle, side, room)) strips.push_back(*strip);
  };
  for (int e : model.face(face).edges) {
    const CadEdge& edge = model.edge(e);
    if (edge.seam || edge.degenerate) continue;
    const std::vector<double> angles = course(model, barrel, e);
    const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
    if (*most - *least < kStraight || std::abs(angles.back() - angles.front()) > std::numbers::pi) continue;
    for (const auto& [furthest, side] : {std::pair(most, 1.0), std::pair(least, -1.0)}) {
      const bool at_end = furthest == angles.begin() || furthest + 1 == angles.end();
      // At a vertex the next edge has to turn back too.
      if (edge.closed || !at_end || ++ends[{edge.vertices[furthest == angles.begin() ? 0 : 1], side}] == 2) add(*furthest, side);
    }
  }
  return strips;
}

void give_room(const CadModel& model, const TetMesh& mesh, const std::vector<Strip>& strips, RegionGraph& graph, std::vector<int>& label) {
  for (std::size_t r = 0; r < label.size(); ++r) {
    Region& region = graph.regions[r];
    Vec3 centre = Vec3::Zero();
    for (int t : region.triangles) {
      for (int n : mesh.triangles[t]) centre += mesh.points[n] / (3.0 * static_cast<double>(region.triangles.size()));
    }
    for (const Strip& s : strips) {
      if (s.face != region.face || s.label == label[r] || region.data[s.label] >= kForbidden) continue;
      const Vec3 axis = model.face(s.face).axis;
      Vec3 arm = centre - model.face(s.face).centre;
      arm -= arm.dot(axis) * axis;
      const bool between = s.generator[0].cross(arm).dot(arm.cross(s.generator[1])) > 0 && arm.dot(s.generator[0] + s.generator[1]) > 0;
      if (!between) continue;
      std::swap(region.data[s.label], region.data[label[r]]);
      label[r] = s.label;
    }
  }
}

}  // namespace polycube
