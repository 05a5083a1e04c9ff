#include "label/label.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

#include "core/charts.h"
#include "label/barrels.h"
#include "label/divide.h"
#include "label/frame.h"
#include "label/graph_cut.h"
#include "label/halves.h"
#include "label/search.h"
#include "label/straighten.h"
#include "label/strays.h"
#include "label/tuning.h"

namespace polycube {
namespace {

struct Setup {
  const CadModel& model;
  const TetMesh& mesh;
  const LabelOptions& options;
  const Tips* tips;           // null: those faces are treated as others
  std::vector<FaceCut> cuts;  // per CAD face: how it is divided, zero for the usual way
  const Room* room;           // null: none beside edges on barrels
  Mat3 frame;
  std::vector<Vec3> normal;  // per triangle, in the frame, as the data term shall see it
  std::vector<double> area;
  std::vector<char> whole;  // per CAD face: one label for all of it
  std::vector<char> flat;   // per CAD face: it hardly bends
  double scale;             // mm

  bool has_tip(int face) const { return tips && !tips->axis[face].isZero(); }
  bool is_cut_cone(int face) const { return cuts[face].level != ConePart::kNone; }
};

Vec3 across(const Vec3& axis, const Vec3& n) { return (n - n.dot(axis) * axis).normalized(); }

Vec3 triangle_normal(const TetMesh& mesh, int t) {
  const Triangle& tri = mesh.triangles[t];
  return (mesh.points[tri[1]] - mesh.points[tri[0]]).cross(mesh.points[tri[2]] - mesh.points[tri[0]]);
}

// On cones and other surfaces round an axis of the frame the labels across the axis are preferred: a ring-shaped chart border in the middle of
// such a face would cut it where nothing in the CAD asks for it, and its outer rim could only be reached diagonally. Tori are treated as the fillets
// are that they continue.
//
// A blunt cone, such as the tip that a drill leaves, counts as the disc that it all but is: labels across its axis would meet in its tip.
//
// Of a cone that is cut in two rings this is the one that faces sideways.
Vec3 as_seen(const Setup& s, int face_id, Vec3 n) {
  const CadFace& face = s.model.face(face_id);
  if (s.is_cut_cone(face_id)) return across(s.cuts[face_id].across, n);
  if (face.kind == SurfaceKind::kCone) {
    const Vec3 axis = s.frame * face.axis;
    if (std::abs(n.dot(axis)) > kLabelTuning.blunt_cosine) return n.dot(axis) > 0 ? axis : Vec3(-axis);
  }
  const bool ring = face.kind == SurfaceKind::kTorus && s.options.widest_bend > std::numbers::pi / 4;
  const bool round = face.kind == SurfaceKind::kCone || face.kind == SurfaceKind::kRevolution || ring;
  if (!round) return n;
  const Vec3 axis = s.frame * face.axis;
  int k = 0;
  if (axis.cwiseAbs().maxCoeff(&k) < kLabelTuning.aligned_cosine || std::abs(n[k]) > 0.97) return n;
  n[k] *= 0.4;
  return n.normalized();
}

double data_cost(const Vec3& normal, int label) {
  const double cosine = label_sign(label) * normal[label_axis(label)];
  const double x = (cosine - 1) / 0.2;
  // The published term saturates; a slope behind keeps wrong directions ordered. A face that stands square to its label's axis is a map that folds: dear.
  return 1 - std::exp(-x * x / 2) + 0.3 * (1 - cosine) + 20 * std::max(0.0, 0.3 - cosine);
}

// What a label costs a triangle that is `normal` as the data term shall see it. A chamfer may be asked to take one axis rather than another.
double data_cost(const Setup& s, int t, int label) {
  const int k = s.options.chamfer_axis;
  const Vec3& normal = s.normal[t];
  if (k < 0 || !is_chamfer(s.model.face(s.mesh.triangle_face[t]), s.frame, k)) return data_cost(normal, label);
  Vec3 turned = normal;
  turned[k] *= kLabelTuning.chamfer_turn;
  return data_cost(turned.normalized(), label);
}

double change_weight(double angle, bool same_face) {
  if (same_face) return 1;
  return std::abs(angle - std::numbers::pi) > kLabelTuning.sharp_bend ? 0.1 : 0.5;
}

/// One ring of each cone that is cut faces along its axis, the other sideways.
void face_cut_cones(Setup& s) {
  std::vector<double> middle(s.cuts.size(), 0);
  for (const int f : s.model.faces()) {
    if (!s.is_cut_cone(f)) continue;
    middle[f] = cut_middle(s.mesh, f, s.cuts[f], s.frame);
    s.whole[f] = 0;
  }
  for (std::size_t t = 0; t < s.normal.size(); ++t) {
    const int f = s.mesh.triangle_face[t];
    if (!s.is_cut_cone(f)) continue;
    const auto& [a, b, c] = s.mesh.triangles[t];
    const Vec3& axis = s.cuts[f].across;
    const bool upper = axis.dot(s.frame * (s.mesh.points[a] + s.mesh.points[b] + s.mesh.points[c])) / 3 > middle[f];
    const bool level = upper == (s.cuts[f].level == ConePart::kUpper);
    s.normal[t] = level ? Vec3(s.normal[t].dot(axis) > 0 ? axis : Vec3(-axis)) : across(axis, s.normal[t]);
  }
}

Setup prepare(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, const Tips* tips, const Mat3& frame, std::vector<FaceCut> face_cuts,
              const Room* room) {
  Setup s{model, mesh, options, tips, std::move(face_cuts), room, frame, {}, {}, {}, {}, 0.02 * model.diagonal()};
  const auto n = mesh.triangles.size();
  s.normal.resize(n);
  s.area.resize(n);
  std::vector<Vec3> mean(model.face_count() + 1, Vec3::Zero());
  for (std::size_t t = 0; t < n; ++t) {
    const Vec3 w = s.frame * triangle_normal(mesh, static_cast<int>(t));
    s.area[t] = w.norm() / 2;
    s.normal[t] = w.normalized();
    mean[mesh.triangle_face[t]] += w;
  }
  s.whole.assign(model.face_count() + 1, 1);
  s.flat.assign(model.face_count() + 1, 1);
  for (std::size_t t = 0; t < n; ++t) {
    const int f = mesh.triangle_face[t];
    const double cosine = s.normal[t].dot(mean[f].normalized());
    if (cosine < std::cos(options.widest_bend)) s.whole[f] = 0;
    if (cosine < kLabelTuning.flat_cosine) s.flat[f] = 0;
  }
  face_cut_cones(s);
  for (std::size_t t = 0; t < n; ++t) {
    const int f = mesh.triangle_face[t];
    if (s.is_cut_cone(f)) continue;
    if (!s.has_tip(f)) {
      s.normal[t] = as_seen(s, f, s.normal[t]);
      continue;
    }
    // The lower half faces sideways, however blunt the tip is; of the upper one the search decides.
    s.whole[f] = 1;
    const Vec3 sideways = s.normal[t] - s.normal[t].dot(tips->axis[f]) * tips->axis[f];
    if (!tips->upper[t] && !sideways.isZero(1e-3)) s.normal[t] = sideways.normalized();
  }
  return s;
}

bool is_barred(const LabelOptions& options, int face, int label) {
  return std::find(options.barred.begin(), options.barred.end(), std::pair(face, label)) != options.barred.end();
}

// Graph cut over triangles, those of a whole face (and of a face the user labelled) taken together. Returns labels per triangle.
std::vector<int> cut_triangles(const Setup& s, const Monitor& monitor) {
  const auto n = s.mesh.triangles.size();
  std::vector<int> given(s.model.face_count() + 1, -1), face_node(s.model.face_count() + 1, -1), node(n);
  for (const auto& [face, label] : s.options.face_labels) given[face] = label;
  CutProblem problem;
  for (std::size_t t = 0; t < n; ++t) {
    const int f = s.mesh.triangle_face[t];
    if (s.whole[f] || given[f] >= 0) {
      if (face_node[f] < 0) {
        face_node[f] = static_cast<int>(problem.data.size());
        problem.data.push_back({});
      }
      node[t] = face_node[f];
    } else {
      node[t] = static_cast<int>(problem.data.size());
      problem.data.push_back({});
    }
    const CadFace& face = s.model.face(f);
    const double scale = face.radius > 0 ? std::min(s.scale, 0.5 * face.radius) : s.scale;
    for (int l = 0; l < 6; ++l) {
      double cost = s.options.fidelity * data_cost(s, static_cast<int>(t), l) * s.area[t] / (scale * s.scale);
      if ((given[f] >= 0 && given[f] != l) || is_barred(s.options, f, l)) cost = kForbidden;
      const bool planar = face.kind == SurfaceKind::kPlane && s.normal[t].cwiseAbs().maxCoeff() > kLabelTuning.aligned_cosine;
      if (given[f] < 0 && planar && label_sign(l) * s.normal[t][label_axis(l)] < kLabelTuning.aligned_cosine) cost = kForbidden;
      problem.data[node[t]][l] = std::min(problem.data[node[t]][l] + cost, kForbidden);
    }
  }
  const auto neighbours = triangle_neighbours(s.mesh.triangles);
  std::map<std::pair<int, int>, double> links;
  for (std::size_t t = 0; t < n; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int m = neighbours[t][k];
      if (m <= static_cast<int>(t) || node[m] == node[t]) continue;
      const double length = (s.mesh.points[s.mesh.triangles[t][k]] - s.mesh.points[s.mesh.triangles[t][(k + 1) % 3]]).norm();
      const double bend = std::acos(std::clamp(s.normal[t].dot(s.normal[m]), -1.0, 1.0));
      const double weight = change_weight(std::numbers::pi - bend, s.mesh.triangle_face[t] == s.mesh.triangle_face[m]);
      links[std::minmax(node[t], node[m])] += s.options.compactness * weight * length / s.scale;
    }
  }
  for (const auto& [pair, weight] : links) problem.links.push_back({pair.first, pair.second, weight});
  const std::vector<int> solution = solve(problem, monitor);
  std::vector<int> labels(n);
  for (std::size_t t = 0; t < n; ++t) labels[t] = solution[node[t]];
  return labels;
}

// The longest side of the box about some triangles.
double extent(const TetMesh& mesh, const std::vector<int>& triangles) {
  Vec3 low = mesh.points[mesh.triangles[triangles.front()][0]], high = low;
  for (int t : triangles) {
    for (int n : mesh.triangles[t]) {
      low = low.cwiseMin(mesh.points[n]);
      high = high.cwiseMax(mesh.points[n]);
    }
  }
  return (high - low).maxCoeff();
}

// Connected triangles of one CAD face, one label and one half. Pieces much smaller than their face's largest join the neighbour they share most
// border with.
struct Split {
  std::vector<int> region;  // per triangle
  std::vector<int> kind;    // per region: half + 8 * label + 64 * sector
};

Split split_regions(const Setup& s, const std::vector<int>& labels, const Halves& halves, const Barrels& barrels, double edge) {
  const auto neighbours = triangle_neighbours(s.mesh.triangles);
  const int n = static_cast<int>(labels.size());
  std::vector<int> kind;
  kind.reserve(labels.size());
  for (int t = 0; t < n; ++t) kind.push_back(halves.half(t) + 8 * labels[t] + 64 * barrels.sector(t));
  std::vector<int> region;
  for (int pass = 0; pass < 3; ++pass) {
    region.assign(n, -1);
    std::vector<std::vector<int>> members;
    std::vector<double> area;
    std::vector<double> largest(s.model.face_count() + 1, 0);
    for (int seed = 0; seed < n; ++seed) {
      if (region[seed] >= 0) continue;
      const int id = static_cast<int>(members.size());
      members.push_back({seed});
      area.push_back(0);
      region[seed] = id;
      for (std::size_t i = 0; i < members[id].size(); ++i) {
        const int t = members[id][i];
        area[id] += s.area[t];
        for (int m : neighbours[t]) {
          if (m < 0 || region[m] >= 0 || kind[m] != kind[seed] || s.mesh.triangle_face[m] != s.mesh.triangle_face[seed]) continue;
          region[m] = id;
          members[id].push_back(m);
        }
      }
      double& big = largest[s.mesh.triangle_face[seed]];
      big = std::max(big, area[id]);
    }
    bool changed = false;
    for (std::size_t id = 0; id < members.size(); ++id) {
      const int face = s.mesh.triangle_face[members[id][0]];
      if (area[id] > kLabelTuning.small_share * largest[face] || s.cuts[face].exact) continue;
      if (s.options.narrow_regions && area[id] > kLabelTuning.narrow * edge * extent(s.mesh, members[id])) continue;
      std::map<int, double> border;
      for (int t : members[id]) {
        for (int k = 0; k < 3; ++k) {
          const int m = neighbours[t][k];
          if (m < 0 || region[m] == static_cast<int>(id) || s.mesh.triangle_face[m] != face) continue;
          border[kind[m]] += (s.mesh.points[s.mesh.triangles[t][k]] - s.mesh.points[s.mesh.triangles[t][(k + 1) % 3]]).norm();
        }
      }
      if (border.empty()) continue;
      const int best = std::max_element(border.begin(), border.end(), [](const auto& x, const auto& y) { return x.second < y.second; })->first;
      for (int t : members[id]) kind[t] = best;
      changed = true;
    }
    if (!changed) break;
  }
  std::vector<int> region_kind(*std::max_element(region.begin(), region.end()) + 1);
  for (int t = 0; t < n; ++t) region_kind[region[t]] = kind[t];
  return {std::move(region), std::move(region_kind)};
}

// A labelling of regions, before the mesh is cut for it.
struct Plan {
  std::shared_ptr<const TetMesh> own_mesh;  // that the setup refers to, where it was cut for this labelling alone
  Setup setup;
  std::optional<Halves> half;  // stands on the setup
  Barrels barrels;
  Split split;
  RegionGraph graph;
  std::vector<int> label;  // per region
  Violations left;
};

// The halves of a side of a barrel count as one for the borders to its other sides, which so do not bend where they pass from half to half. Returns the
// region that stands for each.
std::vector<int> join_halves(const RegionGraph& graph, const Split& split, const Halves& halves) {
  std::map<std::array<int, 2>, std::vector<int>> sides;
  for (int r = 0; r < static_cast<int>(graph.regions.size()); ++r) {
    if (const int face = graph.regions[r].face; halves.barrel(face)) sides[{face, split.kind[r] / 8}].push_back(r);
  }
  std::vector<int> joined(graph.regions.size());
  std::iota(joined.begin(), joined.end(), 0);
  for (const auto& [side, r] : sides) {
    if (r.size() == 2 && split.kind[r[0]] != split.kind[r[1]]) joined[r[1]] = r[0];
  }
  return joined;
}

// The borders between regions of one face that got different labels: half way down a slope, or where the normal is as near to one direction as to the other.
std::vector<BorderFunction> borders(const Plan& plan, const std::vector<int>& joined) {
  const auto& [own_mesh, setup, half, barrels, split, graph, region_label, left] = plan;
  const auto& s = setup;
  const Halves& halves = *half;
  std::vector<BorderFunction> result, half_way;
  std::set<std::pair<int, int>> done;
  for (const Arc& arc : graph.arcs) {
    const int a = joined[arc.left], b = joined[arc.right], face = graph.regions[a].face;
    if (s.has_tip(face)) continue;  // cut already
    if (graph.regions[b].face != face || region_label[arc.left] == region_label[arc.right] || !done.insert(std::minmax(a, b)).second) continue;
    std::vector<int> ends;
    for (const Arc& other : graph.arcs) {
      const int c = joined[other.left], d = joined[other.right];
      if (std::minmax(c, d) != std::minmax(a, b) || other.start < 0) continue;
      for (int j : {other.start, other.end}) ends.push_back(graph.junctions[j].node);
    }
    const int p = split.kind[arc.left], q = split.kind[arc.right];
    if (s.cuts[face].thirds) {
      result.push_back({a, b, halves.third_border(face, p % 8, q % 8), ends});
      continue;
    }
    if (halves.sloping(face) && p % 8 != q % 8 && (p / 8 == q / 8 || s.is_cut_cone(face))) {
      half_way.push_back(
          {p % 8 > q % 8 ? arc.left : arc.right, p % 8 > q % 8 ? arc.right : arc.left, halves.border(face, std::max(p % 8, q % 8), p / 8 % 8), ends});
      continue;
    }
    const int l = s.whole[face] ? p % 8 : p / 8 % 8, m = s.whole[face] ? q % 8 : q / 8 % 8;
    if (s.flat[face]) continue;
    if (std::vector<BorderFunction> along = barrels.borders(graph, a, b, l, m); !along.empty()) {
      result.insert(result.begin(), std::make_move_iterator(along.begin()), std::make_move_iterator(along.end()));  // before others that may end where they do
      continue;
    }
    if (l == m) continue;
    Vec3 direction = Vec3::Zero();
    direction[label_axis(l)] += label_sign(l);
    direction[label_axis(m)] -= label_sign(m);
    result.push_back({a, b,
                      [&s, face, direction](int n) {
                        const FacePoint at = s.model.project_to_face(face, s.mesh.points[n]);
                        return as_seen(s, face, s.frame * s.model.face_normal(face, at.uv)).dot(direction);
                      },
                      ends});
  }
  // Last, when every side has its triangles.
  result.insert(result.end(), half_way.begin(), half_way.end());
  return result;
}

// Per CAD face: may it have more labels than one?
std::vector<char> may_change(const Setup& s) {
  std::vector<char> divided(s.whole.size());
  std::transform(s.whole.begin(), s.whole.end(), divided.begin(), [](char whole) { return !whole; });
  return divided;
}

// `tips`: null where faces with a tip are treated as others; else `mesh` is cut as theirs. So with `room`.
std::unique_ptr<Plan> make_plan(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, const Tips* tips, const Mat3& frame,
                                const std::vector<FaceCut>& cuts, const Room* room, const Monitor& monitor) {
  Setup prepared = prepare(model, mesh, options, tips, frame, cuts, room);
  const std::vector<char> divided = may_change(prepared);
  auto plan = std::make_unique<Plan>(Plan{nullptr, std::move(prepared), {}, Barrels(model, mesh, frame, divided, room), {}, {}, {}, {}});
  const Setup& s = plan->setup;
  std::vector<int> first = cut_triangles(s, monitor);
  for (std::size_t t = 0; t < first.size(); ++t) {
    if (s.has_tip(mesh.triangle_face[t])) first[t] = tips->label[t];
  }
  if (room) settle_lines(model, mesh, frame, *room, first);
  double edge = 0;
  for (const Triangle& t : mesh.triangles) edge += (mesh.points[t[0]] - mesh.points[t[1]]).norm();
  edge /= static_cast<double>(mesh.triangles.size());
  plan->half.emplace(FaceShapes{model, mesh, s.frame, s.normal, s.whole, s.flat, s.cuts, s.tips, room}, first);
  plan->split = split_regions(s, first, *plan->half, plan->barrels, edge);
  plan->graph = build_region_graph(mesh, plan->split.region);
  RegionGraph& graph = plan->graph;
  std::vector<int> given(model.face_count() + 1, -1);
  for (const auto& [face, label] : options.face_labels) given[face] = label;
  std::vector<int>& region_label = plan->label;
  for (Region& r : graph.regions) {
    std::array<double, 6> votes{};
    for (int t : r.triangles) {
      votes[first[t]] += s.area[t];
      for (int l = 0; l < 6; ++l) r.data[l] += options.fidelity * data_cost(s, t, l) * s.area[t] / (s.scale * s.scale);
      if (options.facing) r.normal += s.area[t] * s.normal[t];
    }
    r.normal.normalize();  // a zero one stays
    for (int l = 0; l < 6; ++l) {
      if ((given[r.face] >= 0 && given[r.face] != l) || is_barred(options, r.face, l)) r.data[l] = kForbidden;
    }
    region_label.push_back(static_cast<int>(std::max_element(votes.begin(), votes.end()) - votes.begin()));
  }
  for (Arc& a : graph.arcs) a.weight = options.compactness * change_weight(a.angle, graph.regions[a.left].face == graph.regions[a.right].face) / s.scale;
  std::vector<Vec3> points;
  points.reserve(mesh.points.size());
  for (const Vec3& p : mesh.points) points.push_back(s.frame * p);
  if (room) give_strips(model, mesh, *room, graph, region_label);
  for (double strictness = options.gradual ? std::min(kLabelTuning.first_strictness, options.strictness) : options.strictness;; strictness *= 2) {
    region_label = repair(graph, points, std::move(region_label), 0.75 * edge, std::min(strictness, options.strictness), options.threads, monitor);
    if (strictness >= options.strictness) break;
  }
  plan->left = find_violations(graph, points, region_label, 0.75 * edge);
  return plan;
}

// CAD faces beside a violation.
std::set<int> faces_at_fault(const Plan& plan) {
  std::set<int> faces;
  for (int r : plan.left.regions) faces.insert(plan.graph.regions[r].face);
  return faces;
}

bool label_changes_at_tip(const Plan& plan) {
  const CadModel& model = plan.setup.model;
  const TetMesh& mesh = plan.setup.mesh;
  std::set<std::pair<int, int>> tips;  // face, vertex
  for (const int e : model.edges()) {
    if (model.edge(e).tip) tips.insert({model.edge(e).faces[0], model.edge(e).vertices[0]});
  }
  if (tips.empty()) return false;
  std::map<std::pair<int, int>, std::set<int>> labels;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int n : mesh.triangles[t]) {
      const std::pair at(mesh.triangle_face[t], mesh.point_cad[n].id);
      if (mesh.point_cad[n].dim == 0 && tips.count(at) > 0) labels[at].insert(plan.label[plan.graph.triangle_region[t]]);
    }
  }
  return std::any_of(labels.begin(), labels.end(), [](const auto& tip) { return tip.second.size() > 1; });
}

// Share of the axis of a cone in its normals.
double share_along_axis(const Setup& s, int face) {
  for (std::size_t t = 0; t < s.area.size(); ++t) {
    if (s.mesh.triangle_face[t] == face) return triangle_normal(s.mesh, static_cast<int>(t)).normalized().dot(s.model.face(face).axis);
  }
  return 0;
}

// The ways to divide a face at fault.
std::vector<FaceCut> cuts_of(const Plan& plan, int face) {
  const Setup& s = plan.setup;
  if (s.has_tip(face) || plan.half->barrel(face)) return {};
  std::vector<Vec3> vertices;
  if (s.options.facing) {
    for (int e : s.model.face(face).edges) {
      for (int v : s.model.edge(e).vertices) vertices.push_back(s.frame * s.model.vertex(v));
    }
  }
  if (s.model.face(face).kind == SurfaceKind::kPlane)
    return plan.half->sloping(face) ? plane_cuts(s.frame * s.model.face(face).axis, vertices) : std::vector<FaceCut>{};
  Vec3 mean = Vec3::Zero(), turning = Vec3::Zero();
  for (std::size_t t = 0; t < s.normal.size(); ++t) {
    if (s.mesh.triangle_face[t] == face) mean += s.area[t] * s.normal[t];
  }
  mean.normalize();
  for (std::size_t t = 0; t < s.normal.size(); ++t) {
    if (s.mesh.triangle_face[t] == face) turning = turning.cwiseMax((s.normal[t] - mean).cwiseAbs());
  }
  if (s.flat[face] && plan.half->sloping(face)) return plane_cuts(mean, vertices);
  std::vector<FaceCut> cuts;
  if (s.model.face(face).kind == SurfaceKind::kCone) cuts = cone_cuts(s.frame * s.model.face(face).axis, share_along_axis(s, face));
  const std::vector<FaceCut> bent = bent_cuts(mean, turning);
  cuts.insert(cuts.end(), bent.begin(), bent.end());
  return cuts;
}

double cost(const Plan& plan) { return region_energy(plan.graph, plan.label); }

// Barrels get room beside their edges where that leaves no violation and costs less, or there are violations otherwise; where it costs more, `spare` is
// what to do if the cuts spoil the other.
//
// A labelling that stays invalid may lack a place to change its label: faces with tips are divided below the tip, then oblique planes and bent faces beside the
// violations in other ways, one after the other, as long as that leaves fewer violations.
std::unique_ptr<Plan> best_plan(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, Room& room, Tips& tips, std::unique_ptr<Plan>& spare,
                                const Monitor& monitor) {
  const Mat3 frame = options.frame_given ? options.frame : find_frame(model);
  const std::vector<FaceCut> usual(static_cast<std::size_t>(model.face_count()) + 1);
  std::unique_ptr<Plan> best = make_plan(model, mesh, options, nullptr, frame, usual, nullptr, monitor);
  if (options.room) room = make_room(model, mesh, frame, may_change(best->setup), monitor);
  if (!room.strips.empty()) {
    std::unique_ptr<Plan> roomy = make_plan(model, room.mesh, options, nullptr, frame, usual, &room, monitor);
    if (roomy->left.score == 0) (best->left.score > 0 || cost(*roomy) < cost(*best) ? best : spare) = std::move(roomy);
  }
  const TetMesh& base = best->setup.room ? room.mesh : mesh;
  const auto better_with = [&](const Tips* with, const std::vector<FaceCut>& cuts) {
    // Tips and rooms know the triangles of their meshes: those are not cut again.
    const bool cut = !with && !best->setup.room && std::any_of(cuts.begin(), cuts.end(), [](const FaceCut& c) { return c.exact; });
    const auto own = cut ? std::make_shared<const TetMesh>(cut_faces(mesh, cuts, frame, monitor)) : nullptr;
    std::unique_ptr<Plan> plan = make_plan(model, with ? with->mesh : own ? *own : base, options, with, frame, cuts, best->setup.room, monitor);
    plan->own_mesh = own;
    if (plan->left.score >= best->left.score) return false;
    best = std::move(plan);
    return true;
  };
  if (best->left.sound() && !label_changes_at_tip(*best)) return best;
  tips = divide_tips(model, base, frame, monitor);
  if (tips.any) {
    std::unique_ptr<Plan> divided = make_plan(model, tips.mesh, options, &tips, frame, usual, best->setup.room, monitor);
    // Where the labels change at a tip there is no telling from a few triangles which of them meet there, unless they are cut for it.
    if (divided->left.sound() || divided->left.score < best->left.score) best = std::move(divided);
  }
  int tries = 0;
  for (bool changed = true; changed && !best->left.sound();) {
    changed = false;
    for (int f : faces_at_fault(*best)) {
      for (const FaceCut& cut : cuts_of(*best, f)) {
        if (best->left.sound() || tries++ >= kLabelTuning.most_divisions) return best;
        std::vector<FaceCut> cuts = best->setup.cuts;
        cuts[f] = cut;
        changed |= better_with(best->setup.tips, cuts);
      }
    }
  }
  return best;
}

// The labels of the triangles after all cuts. The plan stands on the mesh.
Labelling realise(const Plan& plan, TetMesh& mesh, const Monitor& monitor) {
  Labelling result;
  result.frame = plan.setup.frame;
  const std::vector<int> joined = join_halves(plan.graph, plan.split, *plan.half);
  std::vector<int> triangle_region;
  for (int r : plan.graph.triangle_region) triangle_region.push_back(joined[r]);
  for (int r : cut_along(mesh, triangle_region, borders(plan, joined), monitor)) result.label.push_back(plan.label[r]);
  split_tied_edges(mesh, result.label, monitor);
  absorb_strays(mesh, result, monitor);
  return result;
}

}  // namespace

bool is_chamfer(const CadFace& face, const Mat3& frame, int axis) {
  const double cosine = std::abs(frame.row(axis).dot(face.axis));
  return face.kind == SurfaceKind::kPlane && cosine > kLabelTuning.chamfer_from && cosine < kLabelTuning.chamfer_to;
}

Labelling label(const CadModel& model, TetMesh& mesh, const LabelOptions& options, const Monitor& monitor, LabelReport* report) {
  monitor.progress("label", 0);
  Room room;
  Tips tips;
  std::unique_ptr<Plan> spare;
  std::unique_ptr<Plan> plan = best_plan(model, mesh, options, room, tips, spare, monitor);
  // Borders ask for points that cutting adds: the plan must stand on the mesh that is cut.
  if (plan->setup.tips || plan->setup.room || plan->own_mesh) {
    mesh = plan->setup.tips ? tips.mesh : plan->own_mesh ? *plan->own_mesh : room.mesh;
    plan = make_plan(model, mesh, options, plan->setup.tips, plan->setup.frame, plan->setup.cuts, plan->setup.room, monitor);
  }
  monitor.progress("label", 0.5);
  Labelling result = realise(*plan, mesh, monitor);
  Violations left = find_violations(mesh, result.frame, result.label);
  if (spare && left.score > 0) {
    Labelling other = realise(*spare, room.mesh, monitor);
    const Violations others = find_violations(room.mesh, other.frame, other.label);
    if (others.score < left.score) {
      mesh = std::move(room.mesh);
      plan = std::move(spare);
      result = std::move(other);
      left = others;
    }
  }
  const RegionGraph& graph = plan->graph;
  const int folded = count_folded_parts(mesh, result.frame, result.label);
  monitor.log("label: " + std::to_string(graph.regions.size()) + " regions, " + std::to_string(left.opposite_arcs) + " opposite arcs, " +
              std::to_string(left.poor_loops) + " missing corners, " + std::to_string(left.bad_corners) + " bad corners, " +
              std::to_string(left.turning_points) + " turning points, " + std::to_string(left.bad_turns) + " bad turns, " + std::to_string(folded) +
              " folded parts of faces");
  if (report) {
    *report = {static_cast<int>(graph.regions.size()),
               static_cast<int>(find_charts(mesh.triangles, result.label).size()),
               left.opposite_arcs,
               left.poor_loops,
               left.bad_corners,
               left.turning_points,
               left.bad_turns,
               folded,
               left.score,
               cost(*plan)};
  }
  monitor.progress("label", 1);
  return result;
}

}  // namespace polycube
