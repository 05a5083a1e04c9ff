#include "label/halves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/charts.h"
#include "label/tuning.h"

namespace polycube {

Halves::Halves(const FaceShapes& shapes, const std::vector<int>& labels) : s_(shapes) {
  const auto n = s_.mesh.triangles.size();
  find_barrels();
  half_.assign(n, 0);
  slope_.assign(barrel_.size(), Vec3::Zero());
  for (std::size_t t = 0; t < n; ++t) {
    const int f = s_.mesh.triangle_face[t];
    if (s_.has_tip(f)) continue;
    if (barrel(f)) {
      slope_[f] = s_.frame * s_.model.face(barrel_[f]).axis;
    } else if (!s_.cuts[f].across.isZero()) {
      slope_[f] = s_.cuts[f].across;
    } else if (s_.flat[f] && slope_[f].isZero() && s_.normal[t].cwiseAbs().maxCoeff() <= kLabelTuning.level_cosine) {
      int axis = 0;
      s_.normal[t].cwiseAbs().maxCoeff(&axis);
      slope_[f] = (Vec3::Unit(axis) - s_.normal[t][axis] * s_.normal[t]).normalized();
    }
  }
  find_middles(labels);
  find_centres();
  for (std::size_t t = 0; t < n; ++t) {
    const int f = s_.mesh.triangle_face[t];
    const Triangle& tri = s_.mesh.triangles[t];
    if (s_.has_tip(f)) {
      half_[t] = s_.tips->upper[t] != 0 ? 1 : 0;
    } else if (s_.cuts[f].thirds) {
      half_[t] =
          third_at(s_.frame * s_.model.face(f).axis, s_.frame * ((s_.mesh.points[tri[0]] + s_.mesh.points[tri[1]] + s_.mesh.points[tri[2]]) / 3) - centre_[f]);
    } else if (sloping(f)) {
      const double at = (along(f, tri[0]) + along(f, tri[1]) + along(f, tri[2])) / 3;
      half_[t] = (at > middle(f, 1, labels[t]) ? 1 : 0) + (!barrel(f) && at > middle(f, 2, labels[t]) ? 1 : 0);
    } else if (s_.whole[f] && !s_.flat[f]) {
      int axis = 0;
      s_.normal[t].cwiseAbs().maxCoeff(&axis);
      half_[t] = 2 * axis + (s_.normal[t][axis] < 0);
    }
  }
}

double Halves::middle(int face, int upper, int label) const { return middle_[face][static_cast<std::size_t>(barrel(face) ? label : upper - 1)]; }

std::function<double(int)> Halves::border(int face, int upper, int label) const {
  return [this, face, at = middle(face, upper, label)](int n) { return along(face, n) - at; };
}

std::function<double(int)> Halves::third_border(int face, int p, int q) const {
  return [this, p, q, normal = Vec3(s_.frame * s_.model.face(face).axis), centre = centre_[face]](int n) {
    return third_side(normal, s_.frame * s_.mesh.points[n] - centre, p, q);
  };
}

void Halves::find_centres() {
  centre_.assign(barrel_.size(), Vec3::Zero());
  std::vector<double> area(barrel_.size(), 0);
  for (std::size_t t = 0; t < s_.mesh.triangles.size(); ++t) {
    const int f = s_.mesh.triangle_face[t];
    if (!s_.cuts[f].thirds) continue;
    const Vec3 &a = s_.mesh.points[s_.mesh.triangles[t][0]], &b = s_.mesh.points[s_.mesh.triangles[t][1]], &c = s_.mesh.points[s_.mesh.triangles[t][2]];
    const double size = (b - a).cross(c - a).norm();
    centre_[f] += size * (s_.frame * ((a + b + c) / 3));
    area[f] += size;
  }
  for (std::size_t f = 1; f < centre_.size(); ++f) {
    if (area[f] > 0) centre_[f] /= area[f];
  }
}

double Halves::along(int face, int node) const { return slope_[face].dot(s_.frame * s_.mesh.points[node]); }

// Half way between both ends. Those of a side of a barrel may be cut aslant: half way between where the one has gone up to and the other has come down to,
// so that the halves share no end.
void Halves::find_middles(const std::vector<int>& labels) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  struct Ends {
    double lowest = kFar, low = -kFar, high = kFar, highest = -kFar;
  };
  std::vector<std::array<Ends, 6>> ends(barrel_.size());
  const auto neighbours = triangle_neighbours(s_.mesh.triangles);
  for (std::size_t t = 0; t < s_.mesh.triangles.size(); ++t) {
    const int f = s_.mesh.triangle_face[t];
    if (!sloping(f)) continue;
    Ends& e = barrel(f) ? ends[barrel_[f]][labels[t]] : ends[f][0];
    for (int k = 0; k < 3; ++k) {
      const Triangle& tri = s_.mesh.triangles[t];
      const double a = along(f, tri[k]), b = along(f, tri[(k + 1) % 3]), inside = along(f, tri[(k + 2) % 3]);
      e.lowest = std::min(e.lowest, a);
      e.highest = std::max(e.highest, a);
      const int beyond = s_.mesh.triangle_face[neighbours[t][k]];
      if (beyond == f || (barrel(f) && barrel_[beyond] == barrel_[f])) continue;
      if (2 * inside > a + b) e.low = std::max({e.low, a, b});
      if (2 * inside < a + b) e.high = std::min({e.high, a, b});
    }
  }
  middle_.resize(barrel_.size());
  for (std::size_t f = 0; f < middle_.size(); ++f) {
    for (std::size_t l = 0; l < 6; ++l) {
      const Ends& e = ends[barrel_[f] > 0 ? static_cast<std::size_t>(barrel_[f]) : f][l];
      middle_[f][l] = barrel_[f] > 0 && e.low < e.high ? (e.low + e.high) / 2 : e.lowest + s_.cuts[f].share * (e.highest - e.lowest);
    }
    if (f == 0 || barrel_[f] > 0 || slope_[f].isZero()) continue;
    const double extent = ends[f][0].highest - ends[f][0].lowest;
    middle_[f][1] = s_.cuts[f].upper < 1 ? ends[f][0].lowest + s_.cuts[f].upper * extent : kFar;
    for (int e : s_.model.face(static_cast<int>(f)).edges) {
      for (int v : s_.model.edge(e).vertices) {
        const double off = middle_[f][0] - slope_[f].dot(s_.frame * s_.model.vertex(v));
        if (std::abs(off) < kLabelTuning.off_vertex * extent) middle_[f][0] += (off < 0 ? -kLabelTuning.aside : kLabelTuning.aside) * extent;
      }
    }
  }
}

// The faces of one bore are halved at one height, or the border would have a step where they join.
void Halves::find_barrels() {
  barrel_.assign(s_.model.face_count() + 1, 0);
  for (const int f : s_.model.faces()) {
    const CadFace& face = s_.model.face(f);
    if (face.kind != SurfaceKind::kCylinder || s_.whole[f] || (s_.room && s_.room->on(f)) ||
        (s_.frame * face.axis).cwiseAbs().maxCoeff() > kLabelTuning.level_cosine)
      continue;
    barrel_[f] = f;
    for (int e : face.edges) {
      const auto& [a, b] = s_.model.edge(e).faces;
      const int other = a == f ? b : a;
      if (other >= f || barrel_[other] == 0) continue;
      const CadFace& next = s_.model.face(other);
      const Vec3 apart = next.centre - face.centre;
      if (std::abs(next.axis.dot(face.axis)) < 1 - 1e-9 || std::abs(next.radius - face.radius) > 1e-6 * face.radius) continue;
      if (apart.cross(face.axis).norm() < 1e-6 * s_.model.diagonal()) barrel_[f] = barrel_[other];
    }
  }
}

}  // namespace polycube
