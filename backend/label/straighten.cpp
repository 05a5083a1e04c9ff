#include "label/straighten.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/charts.h"
#include "core/tet_edit.h"

namespace polycube {
namespace {

// A point nearer to the border than this share of the edge that crosses it is put on the border.
constexpr double kSnap = 0.2;

}  // namespace

std::vector<int> cut_along(TetMesh& mesh, const std::vector<int>& triangle_region, const std::vector<BorderFunction>& borders, const Monitor& monitor) {
  std::vector<int> region = triangle_region;
  TetEditor editor(mesh);
  struct Origin {
    int a, b;
    double t;
  };
  const int given = static_cast<int>(mesh.points.size());
  std::vector<Origin> origins;  // of the points added
  for (const BorderFunction& border : borders) {
    monitor.check();
    const std::function<double(int)> evaluate = [&](int n) -> double {
      if (n < given) return border.value(n);
      const Origin& o = origins[static_cast<std::size_t>(n - given)];
      const double va = evaluate(o.a), vb = evaluate(o.b);
      return va == kNoOpinion || vb == kNoOpinion ? kNoOpinion : (1 - o.t) * va + o.t * vb;
    };
    const auto ours = [&](int t) { return region[t] == border.positive || region[t] == border.negative; };
    std::map<int, double> value, raw;
    std::set<Segment> edges;
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      if (!ours(t)) continue;
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        value.try_emplace(a, evaluate(a));
        raw[a] = value[a];
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
    for (const auto& [a, b] : edges) {
      const double va = value[a], vb = value[b];
      if (va == kNoOpinion || vb == kNoOpinion || va * vb >= 0) continue;
      const double t = va / (va - vb);
      if (t < kSnap) value[a] = 0;
      if (t > 1 - kSnap) value[b] = 0;
    }
    for (const auto& [a, b] : edges) {
      const double va = value[a], vb = value[b];
      if (va == kNoOpinion || vb == kNoOpinion || va * vb >= 0) continue;
      const double t = std::clamp(va / (va - vb), kSnap, 1 - kSnap);
      value[editor.split_edge(a, b, (1 - t) * mesh.points[a] + t * mesh.points[b])] = 0;
      origins.push_back({a, b, t});
    }
    while (region.size() < mesh.triangles.size()) region.push_back(triangle_region[editor.triangle_parent()[region.size()]]);
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      if (!ours(t)) continue;
      double sum = 0;
      for (int n : mesh.triangles[t]) sum += value[n];
      if (sum == 0) {
        // All three on the border: the side that most of it lies on.
        for (int n : mesh.triangles[t]) sum += raw[n];
      }
      if (sum != 0 && sum < kNoOpinion && sum > -kNoOpinion) region[t] = sum > 0 ? border.positive : border.negative;
    }
  }
  return region;
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
