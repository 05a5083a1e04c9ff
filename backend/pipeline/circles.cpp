#include "pipeline/circles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.h"
#include "core/union_find.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

struct Circle {
  double turn = 0;
  int first = 0;  // edge
};

int elements_for(double turn, int per_circle) {
  const double turns = std::min(turn / (2 * std::numbers::pi), kPipelineTuning.most_turns);
  return std::max(1, static_cast<int>(std::ceil(per_circle * turns - kPipelineTuning.circle_slack)));
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
  double turn = 0;
  Vec3 before = model.edge_tangent(edge, from);
  for (int i = 1; i <= kPipelineTuning.turn_steps; ++i) {
    const Vec3 now = model.edge_tangent(edge, from + (to - from) * i / kPipelineTuning.turn_steps);
    turn += std::atan2(before.cross(now).norm(), before.dot(now));
    before = now;
  }
  return turn;
}

std::vector<RoundEdge> round_edges(const CadModel& model, int per_circle) {
  if (per_circle <= 0) return {};
  std::vector<RoundEdge> all;
  std::vector<Vec3> centres;
  for (const int e : model.edges()) {
    const CadEdge& edge = model.edge(e);
    if (edge.seam || edge.degenerate || edge.tiny) continue;
    const auto [from, to] = model.edge_range(e);
    const double turn = edge_turn(model, e, from, to);
    const bool small = turn > 0 && 2 * edge.length / turn < kPipelineTuning.small_circle * model.diagonal();
    const int round = small ? std::min(per_circle, kPipelineTuning.per_small_circle) : per_circle;
    all.push_back({e, turn, elements_for(turn, round), 0, round, 0, {}});
    const Vec3 bend = model.edge_bend(e, (from + to) / 2);
    centres.push_back(model.edge_point(e, (from + to) / 2) + bend / std::max(bend.squaredNorm(), std::numeric_limits<double>::min()));
  }
  // Pieces of one circle: they go on from each other about one centre.
  UnionFind same(all.size());
  std::map<int, std::vector<int>> at_vertex;
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    if (barrel_beside(model, model.edge(all[i].edge)) == 0) continue;
    for (const int v : model.edge(all[i].edge).vertices) {
      for (const int other : at_vertex[v]) {
        if ((centres[i] - centres[other]).norm() < kPipelineTuning.same_centre * model.diagonal()) same.unite(i, other);
      }
      at_vertex[v].push_back(i);
    }
  }
  std::map<int, Circle> circles;  // by root
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    Circle& circle = circles[same.find(i)];
    circle.turn += all[i].turn;
    if (circle.first == 0) circle.first = all[i].edge;
  }
  std::vector<RoundEdge> result;
  for (int i = 0; i < static_cast<int>(all.size()); ++i) {
    RoundEdge& r = all[i];
    const CadEdge& edge = model.edge(r.edge);
    const Circle& circle = circles.at(same.find(i));
    const int barrel = barrel_beside(model, edge);
    if (barrel > 0 && std::abs(circle.turn - 2 * std::numbers::pi) < kPipelineTuning.closed) {
      r.circle = circle.first;
      const bool bore = is_bore(model, barrel, model.edge_point(r.edge, model.edge_range(r.edge)[0]));
      if (bore) r.bore = barrel;
      r.name = name({2, barrel}) + ": " + counted(r.round) + " round the " + (bore ? "bore" : "shaft");
    } else {
      r.name = name({1, r.edge}) + ": " + counted(r.elements) + (edge.closed ? " round the curve" : " along the arc");
    }
    if (r.circle > 0 || r.elements > 1) result.push_back(std::move(r));
  }
  return result;
}

EdgeLevels levels_round_bores(const std::vector<RoundEdge>& edges) {
  EdgeLevels levels;
  for (const RoundEdge& r : edges) {
    for (int fewest = 3 * kPipelineTuning.fewest_round; r.bore > 0 && fewest <= r.round; fewest *= 3) ++levels[r.edge];
  }
  return levels;
}

std::vector<RoundEdge> before_levels(std::vector<RoundEdge> edges, const EdgeLevels& levels) {
  for (RoundEdge& r : edges) {
    const auto at = levels.find(r.edge);
    for (int level = 0; at != levels.end() && level < at->second; ++level) {
      for (int* count : {&r.elements, &r.round}) *count = (*count + 2) / 3;
    }
  }
  return edges;
}

std::vector<int> missing_elements(const std::vector<RoundEdge>& edges, const std::vector<int>& elements) {
  std::map<int, int> round;  // per circle
  std::map<int, bool> whole;
  for (const RoundEdge& r : edges) {
    if (r.circle == 0) continue;
    round[r.circle] += elements[r.edge];
    whole.try_emplace(r.circle, true).first->second &= elements[r.edge] > 0;
  }
  std::vector<int> missing;
  for (const RoundEdge& r : edges) {
    if (r.circle == 0) {
      missing.push_back(elements[r.edge] > 0 ? std::max(0, r.elements - elements[r.edge]) : 0);
    } else {
      missing.push_back(r.circle == r.edge && whole.at(r.circle) ? std::max(0, r.round - round.at(r.circle)) : 0);
    }
  }
  return missing;
}

}  // namespace polycube
