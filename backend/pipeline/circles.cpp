#include "pipeline/circles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.h"

namespace polycube {
namespace {

// A tenth of an element too much is none more: arcs of 90 degrees get no fourth one for rounding, nor for what Boolean operations leave of them.
constexpr double kSlack = 0.1;
// Small circles: their diameter in diagonals, and elements enough for them.
constexpr double kSmallCircle = 1.0 / 100;
constexpr int kPerSmallCircle = 8;
// No edge needs more turns than this: more of them are noise of a spline.
constexpr double kMostTurns = 4;
// A circle that two or more edges make closes within this, radians.
constexpr double kClosed = 0.01;

int elements_for(double turn, int per_circle) {
  const double turns = std::min(turn / (2 * std::numbers::pi), kMostTurns);
  return std::max(1, static_cast<int>(std::ceil(per_circle * turns - kSlack)));
}

/// The cylinder or cone that the edge goes round, or 0.
int barrel_beside(const CadModel& model, const CadEdge& edge) {
  for (int f : edge.faces) {
    if (model.face(f).kind == SurfaceKind::kCylinder || model.face(f).kind == SurfaceKind::kCone) return f;
  }
  return 0;
}

bool is_bore(const CadModel& model, int face, const Vec3& on_it) {
  const CadFace& f = model.face(face);
  const FacePoint foot = model.project_to_face(face, on_it);
  const Vec3 from_centre = foot.point - f.centre;
  return model.face_normal(face, foot.uv).dot(from_centre - from_centre.dot(f.axis) * f.axis) < 0;
}

std::string counted(int elements) { return std::to_string(elements) + (elements == 1 ? " element" : " elements"); }

}  // namespace

double edge_turn(const CadModel& model, int edge, double from, double to) {
  // As many steps as keep one below 90 degrees on an edge that goes round four times.
  constexpr int kSteps = 16;
  double turn = 0;
  Vec3 before = model.edge_tangent(edge, from);
  for (int i = 1; i <= kSteps; ++i) {
    const Vec3 now = model.edge_tangent(edge, from + (to - from) * i / kSteps);
    turn += std::atan2(before.cross(now).norm(), before.dot(now));
    before = now;
  }
  return turn;
}

std::vector<RoundEdge> round_edges(const CadModel& model, int per_circle) {
  std::vector<RoundEdge> result;
  if (per_circle <= 0) return result;
  std::map<std::pair<std::array<int, 2>, int>, double> round;  // turn of the edges between two faces, by barrel: halves of one circle add up
  std::vector<int> per_turn;
  for (const int e : model.edges()) {
    const CadEdge& edge = model.edge(e);
    if (edge.seam || edge.degenerate || edge.tiny) continue;
    const auto [from, to] = model.edge_range(e);
    const double turn = edge_turn(model, e, from, to);
    const bool small = turn > 0 && 2 * edge.length / turn < kSmallCircle * model.diagonal();
    const int n = small ? std::min(per_circle, kPerSmallCircle) : per_circle;
    std::array<int, 2> faces = edge.faces;
    std::sort(faces.begin(), faces.end());
    round[{faces, barrel_beside(model, edge)}] += turn;
    if (elements_for(turn, n) < 2) continue;
    result.push_back({e, turn, elements_for(turn, n), {}});
    per_turn.push_back(n);
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    RoundEdge& r = result[i];
    const CadEdge& edge = model.edge(r.edge);
    std::array<int, 2> faces = edge.faces;
    std::sort(faces.begin(), faces.end());
    const int barrel = barrel_beside(model, edge);
    const bool closed = std::abs(round.at({faces, barrel}) - 2 * std::numbers::pi) < kClosed;
    if (barrel > 0 && closed) {
      const bool bore = is_bore(model, barrel, model.edge_point(r.edge, model.edge_range(r.edge)[0]));
      r.name = name({2, barrel}) + ": " + counted(per_turn[i]) + " round the " + (bore ? "bore" : "shaft");
    } else {
      r.name = name({1, r.edge}) + ": " + counted(r.elements) + (edge.closed ? " round the curve" : " along the arc");
    }
  }
  return result;
}

}  // namespace polycube
