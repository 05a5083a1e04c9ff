#include "label/barrels.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "core/charts.h"
#include "label/tuning.h"

namespace polycube {
namespace {

constexpr double kPi = std::numbers::pi;

double turn(double from, double to) { return std::remainder(to - from, 2 * kPi); }

}  // namespace

Barrels::Barrels(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const std::vector<char>& divided, const Room* room)
    : model_(model), mesh_(mesh), frame_(frame), barrels_(static_cast<std::size_t>(model.face_count()) + 1) {
  for (const int f : model.faces()) {
    const CadFace& face = model.face(f);
    if (!divided[f] || (face.kind != SurfaceKind::kCylinder && face.kind != SurfaceKind::kCone)) continue;
    Barrel& barrel = barrels_[f];
    barrel.across[0] = face.axis.unitOrthogonal();
    barrel.across[1] = face.axis.cross(barrel.across[0]);
    std::set<int> vertices;
    for (int e : face.edges) {
      if (!model.edge(e).seam && !model.edge(e).closed) vertices.insert(model.edge(e).vertices.begin(), model.edge(e).vertices.end());
    }
    for (int v : vertices) {
      const double at = angle(f, model.vertex(v));
      barrel.generators.push_back(at);
      // The normal there; within 5 degrees of 45 the cut by label serves.
      Vec3 n = frame * (std::cos(at) * barrel.across[0] + std::sin(at) * barrel.across[1]);
      n = n.cwiseAbs();
      std::sort(n.data(), n.data() + 3);
      if (std::atan2(n[2], n[1]) < kPi / 4 + kLabelTuning.near_generators) continue;
      cut_at(barrel, at);
    }
    for (const Strip& strip : room ? room->strips : std::vector<Strip>()) {
      if (strip.face != f) continue;
      const double at = angle(f, face.centre + strip.generator[1]);
      barrel.generators.push_back(at);
      cut_at(barrel, at);
    }
    std::sort(barrel.generators.begin(), barrel.generators.end());
    std::sort(barrel.cuts.begin(), barrel.cuts.end());
    if (barrel.cuts.size() < 2) barrel.cuts.clear();  // one generator does not divide a full turn, and a part of one has its end there
  }
}

void Barrels::cut_at(Barrel& barrel, double angle) {
  const bool new_cut = std::none_of(barrel.cuts.begin(), barrel.cuts.end(), [&](double c) { return std::abs(turn(c, angle)) < kLabelTuning.near_generators; });
  if (new_cut) barrel.cuts.push_back(angle);
}

double Barrels::angle(int face, const Vec3& p) const {
  const Vec3 arm = p - model_.face(face).centre;
  return std::atan2(arm.dot(barrels_[face].across[1]), arm.dot(barrels_[face].across[0]));
}

int Barrels::sector(int triangle) const {
  const int face = mesh_.triangle_face[triangle];
  const auto& cuts = barrels_[face].cuts;
  if (cuts.empty()) return 0;
  Vec3 centre = Vec3::Zero();
  for (int n : mesh_.triangles[triangle]) centre += mesh_.points[n] / 3;
  return static_cast<int>(std::lower_bound(cuts.begin(), cuts.end(), angle(face, centre)) - cuts.begin()) % static_cast<int>(cuts.size());
}

double Barrels::mean_angle(int face, const std::vector<int>& nodes) const {
  double x = 0, y = 0;
  for (int n : nodes) {
    const double at = angle(face, mesh_.points[n]);
    x += std::cos(at);
    y += std::sin(at);
  }
  return std::atan2(y, x);
}

// How far the region lies beyond the cut (positive) or before it, on the cut's side of the barrel.
double Barrels::share_beyond(int face, const Region& region, double cut) const {
  double sum = 0;
  for (int t : region.triangles) {
    const double beyond = turn(cut, mean_angle(face, {mesh_.triangles[t].begin(), mesh_.triangles[t].end()}));
    if (std::abs(beyond) < kPi / 2) sum += beyond;
  }
  return sum;
}

std::vector<BorderFunction> Barrels::borders(const RegionGraph& graph, int a, int b, int l, int m) const {
  const int face = graph.regions[a].face;
  const Barrel& barrel = barrels_[face];
  Vec3 direction = Vec3::Zero();
  if (l != m) {
    direction[label_axis(l)] += label_sign(l);
    direction[label_axis(m)] -= label_sign(m);
  }
  if (barrel.generators.empty() || std::abs(direction.dot(frame_ * model_.face(face).axis)) > kLabelTuning.across) return {};
  const double line = std::atan2(-direction.dot(frame_ * barrel.across[0]), direction.dot(frame_ * barrel.across[1]));
  std::map<double, std::vector<int>> chosen;  // generator -> where its arcs end
  for (const Arc& arc : graph.arcs) {
    if (std::minmax(arc.left, arc.right) != std::minmax(a, b)) continue;
    const double at = mean_angle(face, arc.nodes);
    double cut = 0;
    const auto by_distance_to = [](double x) { return [x](double p, double q) { return std::abs(turn(x, p)) < std::abs(turn(x, q)); }; };
    if (l != m) {
      const double half_way = std::abs(turn(at, line)) < kPi / 2 ? line : line + kPi;
      const double beside = *std::min_element(barrel.generators.begin(), barrel.generators.end(), by_distance_to(half_way));
      const double nearest = *std::min_element(barrel.generators.begin(), barrel.generators.end(), by_distance_to(at));
      if (std::abs(turn(nearest, at)) < std::abs(turn(half_way, at))) {
        cut = nearest;
      } else if (std::abs(turn(beside, half_way)) < kLabelTuning.near_generators) {
        cut = beside;
      } else {
        return {};
      }
    } else {
      cut = *std::min_element(barrel.generators.begin(), barrel.generators.end(), by_distance_to(at));
    }
    if (arc.start < 0) continue;
    for (int j : {arc.start, arc.end}) chosen[cut].push_back(graph.junctions[j].node);
  }
  std::vector<BorderFunction> result;
  for (const auto& [generator, ends] : chosen) {
    const double cut = generator;
    double reach = kPi / 2;
    for (const auto& [other, unused] : chosen) {
      if (other != cut) reach = std::min(reach, std::abs(turn(cut, other)) / 2);
    }
    const double sign = share_beyond(face, graph.regions[a], cut) > share_beyond(face, graph.regions[b], cut) ? 1 : -1;
    result.push_back({a, b,
                      [this, face, cut, sign, reach](int n) {
                        const double beyond = turn(cut, angle(face, mesh_.points[n]));
                        return std::abs(beyond) < reach ? sign * std::sin(beyond) : kNoOpinion;
                      },
                      ends});
  }
  return result;
}

}  // namespace polycube
