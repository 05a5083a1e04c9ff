#include "label/straighten.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/charts.h"
#include "core/tet_edit.h"
#include "label/tuning.h"

namespace polycube {
namespace {

class Cutter {
 public:
  Cutter(TetMesh& mesh, const std::vector<int>& triangle_region, const std::vector<BorderFunction>& borders, const Monitor& monitor)
      : mesh_(mesh), borders_(borders), monitor_(monitor), region_(triangle_region), editor_(mesh), given_(static_cast<int>(mesh.points.size())) {
    for (const Triangle& t : mesh.triangles) edge_ += (mesh.points[t[0]] - mesh.points[t[1]]).norm() / static_cast<double>(mesh.triangles.size());
  }

  std::vector<int> run() {
    const std::set<const BorderFunction*> again = meeting();
    for (const BorderFunction& b : borders_) cut(b);
    // Where three meet, what a later border took from the third region may belong to the second one.
    for (const BorderFunction& b : borders_) {
      if (again.count(&b) > 0) cut(b);
    }
    return std::move(region_);
  }

 private:
  struct Origin {
    int a, b;
    double t;
  };
  struct Anchor {
    Vec3 at;
    double value;   // of the border's function there
    double radius;  // within which the function is changed, so that it is zero there
  };

  double evaluate(const BorderFunction& border, int n) const {
    if (n < given_ || moved_.count(n) > 0) return border.value(n);
    const Origin& o = origins_[static_cast<std::size_t>(n - given_)];
    const double va = evaluate(border, o.a), vb = evaluate(border, o.b);
    return va == kNoOpinion || vb == kNoOpinion ? kNoOpinion : (1 - o.t) * va + o.t * vb;
  }

  bool ours(const BorderFunction& border, int t) const { return region_[t] == border.positive || region_[t] == border.negative; }

  // The borders of which three meet in one point inside a face.
  std::set<const BorderFunction*> meeting() const {
    std::map<std::pair<int, int>, const BorderFunction*> of_pair;
    for (const BorderFunction& b : borders_) of_pair[std::minmax(b.positive, b.negative)] = &b;
    std::map<int, std::set<int>> regions_at;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      for (int n : mesh_.triangles[t]) {
        if (mesh_.point_cad[n].dim == 2) regions_at[n].insert(region_[t]);
      }
    }
    std::set<const BorderFunction*> found;
    for (const auto& [node, regions] : regions_at) {
      if (regions.size() < 3) continue;
      for (int a : regions) {
        for (int b : regions) {
          if (const auto border = of_pair.find({a, b}); border != of_pair.end()) found.insert(border->second);
        }
      }
    }
    return found;
  }

  // Where the border has to end.
  std::vector<Anchor> anchors(const BorderFunction& border) const {
    std::vector<Anchor> result;
    for (int end : border.ends) {
      const auto pin = pins_.find(end);
      if (mesh_.point_cad[end].dim != 0 && pin == pins_.end()) continue;
      const int node = mesh_.point_cad[end].dim == 0 ? end : pin->second;
      const double value = evaluate(border, node);
      if (value == kNoOpinion || value == 0) continue;
      double slope = 0;
      for (int t : editor_.triangles_at(node)) {
        if (!ours(border, t)) continue;
        for (int n : mesh_.triangles[t]) {
          const double other = n == node ? kNoOpinion : evaluate(border, n);
          if (other != kNoOpinion) slope = std::max(slope, std::abs(other - value) / (mesh_.points[n] - mesh_.points[node]).norm());
        }
      }
      if (slope > 0)
        result.push_back({mesh_.points[node], value, std::max(kLabelTuning.bend_length * std::abs(value) / slope, kLabelTuning.bend_edges * edge_)});
    }
    return result;
  }

  // Remembers where the border ends on CAD edges now.
  void pin(const BorderFunction& border, const std::map<int, double>& value) {
    for (int end : border.ends) {
      const CadRef cad = mesh_.point_cad[end];
      if (cad.dim != 1 || pins_.count(end) > 0) continue;
      double nearest = kLabelTuning.stray * edge_;
      for (const auto& [n, v] : value) {
        const double way = (mesh_.points[n] - mesh_.points[end]).norm();
        if (v != 0 || mesh_.point_cad[n] != cad || way >= nearest) continue;
        nearest = way;
        pins_[end] = n;
      }
    }
  }

  void cut(const BorderFunction& border) {
    monitor_.check();
    const std::vector<Anchor> anchored = anchors(border);
    const auto bent = [&](int n) {
      double v = evaluate(border, n);
      if (v == kNoOpinion) return v;
      for (const Anchor& a : anchored) v -= a.value * std::max(0.0, 1 - (mesh_.points[n] - a.at).norm() / a.radius);
      return v;
    };
    std::map<int, double> value, raw;
    std::set<Segment> edges;
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      if (!ours(border, t)) continue;
      for (int k = 0; k < 3; ++k) {
        const int a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        if (value.count(a) == 0) value[a] = raw[a] = bent(a);
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
    snap(edges, value);
    for (const auto& [a, b] : edges) {
      const double va = value[a], vb = value[b];
      if (va == kNoOpinion || vb == kNoOpinion || va * vb >= 0) continue;
      const double t = std::clamp(va / (va - vb), kLabelTuning.thinnest, 1 - kLabelTuning.thinnest);
      value[editor_.split_edge(a, b, (1 - t) * mesh_.points[a] + t * mesh_.points[b])] = 0;
      origins_.push_back({a, b, t});
    }
    while (region_.size() < mesh_.triangles.size()) region_.push_back(region_[editor_.triangle_parent()[region_.size()]]);
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      if (!ours(border, t)) continue;
      double sum = 0;
      for (int n : mesh_.triangles[t]) sum += value[n];
      if (sum == 0) {
        // All three on the border: the side that most of it lies on.
        for (int n : mesh_.triangles[t]) sum += raw[n];
      }
      if (sum != 0 && sum < kNoOpinion && sum > -kNoOpinion) region_[t] = sum > 0 ? border.positive : border.negative;
    }
    pin(border, value);
  }

  // Points next to the border count as on it; those that may move, inside their face or along their CAD edge, are put there, so that the border is straight.
  // Where that would turn a tet inside out the border passes beside the point.
  void snap(const std::set<Segment>& edges, std::map<int, double>& value) {
    std::map<int, std::pair<double, Vec3>> moves;  // shortest first
    std::set<int> snapped;
    const auto towards = [&](int from, int to, double share) {
      snapped.insert(from);
      const int dim = mesh_.point_cad[from].dim;
      if (dim != 2 && !(dim == 1 && editor_.is_segment(from, to))) return;
      const Vec3 way = share * (mesh_.points[to] - mesh_.points[from]);
      const auto [it, fresh] = moves.try_emplace(from, way.norm(), way);
      if (!fresh && way.norm() < it->second.first) it->second = {way.norm(), way};
    };
    for (const auto& [a, b] : edges) {
      const double va = value[a], vb = value[b];
      if (va == kNoOpinion || vb == kNoOpinion || va * vb >= 0) continue;
      const double t = va / (va - vb);
      if (t < kLabelTuning.snap) towards(a, b, t);
      if (t > 1 - kLabelTuning.snap) towards(b, a, 1 - t);
    }
    for (const auto& [node, move] : moves) {
      if (editor_.move(node, mesh_.points[node] + move.second)) {
        moved_.insert(node);
      } else {
        snapped.erase(node);
      }
    }
    for (int n : snapped) value[n] = 0;
  }

  TetMesh& mesh_;
  const std::vector<BorderFunction>& borders_;
  const Monitor& monitor_;
  std::vector<int> region_;
  TetEditor editor_;
  int given_;
  std::vector<Origin> origins_;  // of the points added
  std::set<int> moved_;          // of the points added
  std::map<int, int> pins_;      // where borders ended on CAD edges -> the point where the first of them ends since it was cut
  double edge_ = 0;              // mean length
};

}  // namespace

std::vector<int> cut_along(TetMesh& mesh, const std::vector<int>& triangle_region, const std::vector<BorderFunction>& borders, const Monitor& monitor) {
  return Cutter(mesh, triangle_region, borders, monitor).run();
}

void split_tied_edges(TetMesh& mesh, std::vector<int>& labels, const Monitor& monitor) {
  for (int pass = 0; pass < 3; ++pass) {
    monitor.check();
    const std::vector<Chart> charts = find_charts(mesh.triangles, labels);
    std::vector<std::vector<int>> charts_at(mesh.points.size());
    std::vector<int> chart_of(mesh.triangles.size());
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
      for (int n : charts[c].nodes) charts_at[n].push_back(c);
      for (int t : charts[c].triangles) chart_of[t] = c;
    }
    std::map<Segment, std::array<int, 2>> sides;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        const auto [it, fresh] = sides.try_emplace({std::min(a, b), std::max(a, b)}, std::array<int, 2>{t, -1});
        if (!fresh) it->second[1] = t;
      }
    }
    TetEditor editor(mesh);
    bool changed = false;
    for (const auto& [edge, beside] : sides) {
      if (chart_of[beside[0]] != chart_of[beside[1]]) continue;
      int shared = 0;
      for (int c : charts_at[edge[0]]) shared += std::binary_search(charts_at[edge[1]].begin(), charts_at[edge[1]].end(), c);
      if (shared < 2) continue;
      editor.split_edge(edge[0], edge[1], (mesh.points[edge[0]] + mesh.points[edge[1]]) / 2);
      changed = true;
    }
    while (labels.size() < mesh.triangles.size()) labels.push_back(labels[editor.triangle_parent()[labels.size()]]);
    if (!changed) break;
  }
}

}  // namespace polycube
