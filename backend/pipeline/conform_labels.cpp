#include "pipeline/conform_labels.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/charts.h"
#include "core/sorted.h"
#include "label/choice.h"
#include "label/validity.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

// A face and a label in one number, which cells that are cut hand on to their parts: 8 * face + label + 1, without label 8 * face.
int code_of(int face, int label) { return 8 * face + label + 1; }
int face_in(int code) { return code / 8; }
int label_in(int code) { return code % 8 - 1; }

bool has(const std::vector<int>& numbers, int id) { return std::binary_search(numbers.begin(), numbers.end(), id); }

/// Everything on which labels are, outer and inner, in one list.
class Skin {
 public:
  Skin(const ConformalModel& model, const TetMesh& tets) : model_(model), mesh_(tets) {
    triangles_ = tets.triangles;
    triangles_.insert(triangles_.end(), tets.inner_triangles.begin(), tets.inner_triangles.end());
    for (const auto* faces : {&tets.triangle_face, &tets.inner_face})
      for (const int f : *faces) code_.push_back(code_of(f, -1));
    segments_ = tets.segments;
    segments_.insert(segments_.end(), tets.inner_segments.begin(), tets.inner_segments.end());
    edge_ = tets.segment_edge;
    edge_.insert(edge_.end(), tets.inner_segment_edge.begin(), tets.inner_segment_edge.end());
    vertices_ = tets.inner_vertices;
    for (int p = 0; p < static_cast<int>(tets.points.size()); ++p)
      if (tets.point_cad[p].dim == 0) vertices_.emplace_back(p, tets.point_cad[p].id);
  }

  /// The mesh with the boundary of one solid, which is all that its labels know; the whole skin goes along as what is between solids, to be cut with it.
  TetMesh view(int solid) const {
    const CadModel& model = model_.solids[static_cast<std::size_t>(solid)];
    TetMesh view = mesh_;
    view.triangles.clear();
    view.triangle_face.clear();
    view.segments.clear();
    view.segment_edge.clear();
    view.inner_triangles = triangles_;
    view.inner_face = code_;
    view.inner_segments = segments_;
    view.inner_segment_edge = edge_;
    view.inner_vertices.clear();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const int face = face_in(code_[t]);
      if (!has(model.faces(), face)) continue;
      Triangle triangle = triangles_[t];
      if (seen_from(face) != solid) std::swap(triangle[1], triangle[2]);
      view.triangles.push_back(triangle);
      view.triangle_face.push_back(face);
    }
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      if (!has(model.edges(), edge_[s])) continue;
      view.segments.push_back(segments_[s]);
      view.segment_edge.push_back(edge_[s]);
    }
    classify(view);
    return view;
  }

  /// Takes over a view that was cut, with the labels of its triangles; what another solid has labelled before stays.
  void take(int solid, const TetMesh& view, const std::vector<int>& labels) {
    mesh_.points = view.points;
    mesh_.tets = view.tets;
    mesh_.tet_solid = view.tet_solid;
    triangles_ = view.inner_triangles;
    segments_ = view.inner_segments;
    edge_ = view.inner_segment_edge;
    code_ = with_labels(solid, view, labels);
  }

  /// Faces of a solid that others have given one label all over, as it sees them.
  FaceLabels given_by_others(int solid) const {
    std::map<int, std::set<int>> found;
    for (const int code : code_) found[face_in(code)].insert(label_in(code));
    FaceLabels labels;
    for (const int f : model_.solids[static_cast<std::size_t>(solid)].faces()) {
      const auto at = found.find(f);
      if (at == found.end() || at->second.size() != 1 || *at->second.begin() < 0) continue;
      labels.emplace_back(f, seen_from(f) == solid ? *at->second.begin() : *at->second.begin() ^ 1);
    }
    return labels;
  }

  /// The labels of a view as they would be taken.
  std::vector<int> agreed(int solid, const TetMesh& view, const std::vector<int>& labels) const {
    std::map<Triangle, int> code_at;
    const std::vector<int> codes = with_labels(solid, view, labels);
    for (std::size_t t = 0; t < codes.size(); ++t) code_at[sorted(view.inner_triangles[t])] = codes[t];
    std::vector<int> result;
    for (const Triangle& t : view.triangles) {
      const int code = code_at.at(sorted(t));
      result.push_back(seen_from(face_in(code)) == solid ? label_in(code) : label_in(code) ^ 1);
    }
    return result;
  }

  ConformalLabels labels(const Mat3& frame) const {
    ConformalLabels result;
    result.mesh = mesh_;
    TetMesh& mesh = result.mesh;
    mesh.triangles.clear();
    mesh.triangle_face.clear();
    mesh.inner_triangles.clear();
    mesh.inner_face.clear();
    mesh.segments.clear();
    mesh.segment_edge.clear();
    mesh.inner_segments.clear();
    mesh.inner_segment_edge.clear();
    mesh.inner_vertices.clear();
    result.labelling.frame = frame;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const int face = face_in(code_[t]);
      const bool outer = has(model_.outer.faces(), face);
      (outer ? mesh.triangles : mesh.inner_triangles).push_back(triangles_[t]);
      (outer ? mesh.triangle_face : mesh.inner_face).push_back(face);
      (outer ? result.labelling.label : result.inner_label).push_back(label_in(code_[t]));
    }
    for (std::size_t s = 0; s < segments_.size(); ++s) {
      const bool outer = has(model_.outer.edges(), edge_[s]);
      (outer ? mesh.segments : mesh.inner_segments).push_back(segments_[s]);
      (outer ? mesh.segment_edge : mesh.inner_segment_edge).push_back(edge_[s]);
    }
    classify(mesh);
    for (const auto& [point, vertex] : vertices_)
      if (mesh.point_cad[point].dim == 3) mesh.inner_vertices.emplace_back(point, vertex);
    return result;
  }

 private:
  /// The solid that a triangle's normal points out of: of an interface the first.
  int seen_from(int face) const {
    for (const auto& [interface, solids] : model_.interfaces)
      if (interface == face) return solids[0];
    for (int s = 0; s < static_cast<int>(model_.solids.size()); ++s)
      if (has(model_.solids[static_cast<std::size_t>(s)].faces(), face)) return s;
    return -1;
  }

  std::vector<int> with_labels(int solid, const TetMesh& view, const std::vector<int>& labels) const {
    std::map<Triangle, int> label_at;
    for (std::size_t t = 0; t < labels.size(); ++t) label_at[sorted(view.triangles[t])] = labels[t];
    std::vector<int> codes = view.inner_face;
    for (std::size_t t = 0; t < codes.size(); ++t) {
      if (label_in(codes[t]) >= 0) continue;
      if (const auto at = label_at.find(sorted(view.inner_triangles[t])); at != label_at.end())
        codes[t] = code_of(face_in(codes[t]), seen_from(face_in(codes[t])) == solid ? at->second : at->second ^ 1);
    }
    return codes;
  }

  /// Every point of a boundary by the least that it is on.
  void classify(TetMesh& mesh) const {
    mesh.point_cad.assign(mesh.points.size(), {3, 1});
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const int p : mesh.triangles[t]) mesh.point_cad[p] = {2, mesh.triangle_face[t]};
    for (std::size_t s = 0; s < mesh.segments.size(); ++s)
      for (const int p : mesh.segments[s]) mesh.point_cad[p] = {1, mesh.segment_edge[s]};
    for (const auto& [point, vertex] : vertices_)
      if (mesh.point_cad[point].dim < 3) mesh.point_cad[point] = {0, vertex};
  }

  const ConformalModel& model_;
  TetMesh mesh_;
  std::vector<Triangle> triangles_;
  std::vector<int> code_;  ///< per triangle: face and label
  std::vector<Segment> segments_;
  std::vector<int> edge_;
  std::vector<std::pair<int, int>> vertices_;  ///< points and CAD vertices
};

/// Labels that no part of a face may have, as its solid sees them.
using Barred = std::set<std::pair<int, int>>;

struct Attempt {
  ConformalLabels labels;
  std::vector<int> at_fault;  ///< solids that have faults with what those before them gave, in the order in which they were labelled
};

class Labeller {
 public:
  Labeller(const ConformalModel& model, const TetMesh& tets, const LabelOptions& options, const GivenLabels& given, int attempt, const Monitor& monitor)
      : model_(model), tets_(tets), options_(options), given_(given), attempt_(attempt), monitor_(monitor) {}

  Attempt label(const std::vector<int>& order, const Barred& barred) const {
    Skin skin(model_, tets_);
    Attempt result;
    double faults = 0;
    for (const int s : order) {
      const CadModel& solid = model_.solids[static_cast<std::size_t>(s)];
      const TetMesh view = skin.view(s);
      LabelOptions own = options_;
      own.face_labels = given_.faces[static_cast<std::size_t>(s)];
      for (const auto& label : skin.given_by_others(s))
        if (std::none_of(own.face_labels.begin(), own.face_labels.end(), [&](const auto& known) { return known.first == label.first; }))
          own.face_labels.push_back(label);
      std::sort(own.face_labels.begin(), own.face_labels.end());
      for (const auto& label : barred)
        if (has(solid.faces(), label.first)) own.barred.push_back(label);
      LabelChoice choice(solid, view, own, {options_.frame}, false, given_.left_out, monitor_);
      const std::vector<LabelVariant>& variants = choice.order();
      const Labelled& chosen = choice.labelled(variants[static_cast<std::size_t>(attempt_) % variants.size()]);
      const double score = find_violations(chosen.mesh, options_.frame, skin.agreed(s, chosen.mesh, chosen.labelling.label)).score;
      if (score > 0) result.at_fault.push_back(s);
      faults += score;
      skin.take(s, chosen.mesh, chosen.labelling.label);
    }
    result.labels = skin.labels(options_.frame);
    result.labels.faults = faults + find_violations(result.labels.mesh, options_.frame, result.labels.labelling.label).score;
    return result;
  }

 private:
  const ConformalModel& model_;
  const TetMesh& tets_;
  const LabelOptions& options_;
  const GivenLabels& given_;
  int attempt_;
  const Monitor& monitor_;
};

/// Where the outsides of two solids meet with opposite labels, as a ball's with the plate that it is let into a little, nothing is left of what is between
/// them: the face of the solid that was labelled later may not have that label.
Barred opposite_outsides(const ConformalModel& model, const ConformalLabels& labels, const std::vector<int>& order) {
  const auto turn = [&](int face) {
    return std::find_if(order.begin(), order.end(), [&](int s) { return has(model.solids[static_cast<std::size_t>(s)].faces(), face); }) - order.begin();
  };
  const TetMesh& mesh = labels.mesh;
  const std::vector<int>& label = labels.labelling.label;
  const auto neighbours = triangle_neighbours(mesh.triangles);
  Barred barred;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int n : neighbours[t]) {
      if (n < 0 || label[static_cast<std::size_t>(n)] != (label[t] ^ 1)) continue;
      if (turn(mesh.triangle_face[static_cast<std::size_t>(n)]) < turn(mesh.triangle_face[t])) barred.insert({mesh.triangle_face[t], label[t]});
    }
  }
  return barred;
}

}  // namespace

ConformalLabels label_conformally(const ConformalModel& model, const TetMesh& tets, const LabelOptions& options, const GivenLabels& given, int attempt,
                                  const Monitor& monitor) {
  const Labeller labeller(model, tets, options, given, attempt, monitor);
  // Those with most faces first: the others are more likely to follow.
  std::vector<int> order(model.solids.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return model.solids[static_cast<std::size_t>(a)].faces().size() > model.solids[static_cast<std::size_t>(b)].faces().size();
  });
  Attempt now = labeller.label(order, {});
  ConformalLabels best = now.labels;
  Barred barred;
  std::set<int> first;
  // Another order costs as much again: only the first labelling is worth it, and only if it has no faults then.
  for (int tries = 0; attempt == 0 && now.labels.faults > 0 && tries < kPipelineTuning.conform_labellings; ++tries) {
    const auto stuck = std::find_if(now.at_fault.begin(), now.at_fault.end(), [&](int s) { return s != order.front() && !first.contains(s); });
    const std::size_t known = barred.size();
    barred.merge(opposite_outsides(model, now.labels, order));
    if (stuck == now.at_fault.end() && barred.size() == known) break;
    if (stuck != now.at_fault.end()) {  // one that cannot follow decides itself
      first.insert(*stuck);
      const auto at = std::find(order.begin(), order.end(), *stuck);
      std::rotate(order.begin(), at, at + 1);
    }
    now = labeller.label(order, barred);
  }
  if (now.labels.faults == 0) best = now.labels;
  monitor.log("conform: labelling " + std::to_string(attempt + 1) + ": score " + std::to_string(best.faults));
  return best;
}

InterfaceCharts interface_charts(const ConformalLabels& labels) {
  const TetMesh& mesh = labels.mesh;
  InterfaceCharts result;
  result.chart.assign(mesh.inner_triangles.size(), -1);
  // By the two solids: more than two triangles meet at an edge where three solids do.
  std::map<Triangle, std::array<int, 2>> solids_at;
  for (const Triangle& t : mesh.inner_triangles) solids_at[sorted(t)] = {-1, -1};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    for (std::size_t skip = 0; skip < 4; ++skip) {
      const auto at = solids_at.find(sorted(Triangle{tet[(skip + 1) % 4], tet[(skip + 2) % 4], tet[(skip + 3) % 4]}));
      if (at == solids_at.end()) continue;
      at->second[at->second[0] < 0 ? 0 : 1] = mesh.tet_solid[t];
    }
  }
  std::map<std::array<int, 2>, std::vector<int>> parts;
  for (int t = 0; t < static_cast<int>(mesh.inner_triangles.size()); ++t) parts[sorted(solids_at.at(sorted(mesh.inner_triangles[t])))].push_back(t);
  for (const auto& [solids, members] : parts) {
    std::vector<Triangle> triangles;
    std::vector<int> own_labels;
    for (const int t : members) {
      triangles.push_back(mesh.inner_triangles[t]);
      own_labels.push_back(labels.inner_label[t]);
    }
    for (Chart& chart : find_charts(triangles, own_labels)) {
      for (const int t : chart.triangles) result.chart[members[t]] = static_cast<int>(result.charts.size());
      chart.sign = 0;
      chart.triangles.clear();
      result.charts.push_back(std::move(chart));
    }
  }
  return result;
}

}  // namespace polycube
