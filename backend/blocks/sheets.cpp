#include "blocks/sheets.h"

#include <algorithm>
#include <cmath>

#include "blocks/tuning.h"
#include "core/error.h"
#include "core/union_find.h"

namespace polycube {
namespace {

void find_planes(const PolycuboidMap& map, SheetCuts& cuts) {
  Vec3 low = map.image.front(), high = low;
  for (const Vec3& p : map.image) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  cuts.tolerance = kBlocksTuning.same_plane * (high - low).maxCoeff();
  cuts.image = map.image;
  cuts.chart_plane.assign(map.charts.size(), -1);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<int> order;
    for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
      if (map.charts[c].axis == axis) order.push_back(c);
    }
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return map.charts[a].value != map.charts[b].value ? map.charts[a].value < map.charts[b].value : a < b; });
    double last = 0;
    for (int c : order) {
      const Chart& chart = map.charts[c];
      if (cuts.planes[axis].empty() || chart.value - last > cuts.tolerance) cuts.planes[axis].push_back(chart.value);
      last = chart.value;
      cuts.chart_plane[c] = static_cast<int>(cuts.planes[axis].size()) - 1;
      for (int node : chart.nodes) {
        if (std::abs(map.image[node][axis] - chart.value) > cuts.tolerance) {
          throw InvalidInput("the map does not put the nodes of chart " + std::to_string(c) + " on its plane");
        }
        cuts.image[node][axis] = cuts.planes[axis].back();
      }
    }
  }
}

void find_signs(const TetMesh& mesh, const PolycuboidMap& map, SheetCuts& cuts) {
  cuts.collapsed.assign(map.charts.size(), 0);
  cuts.sign.assign(map.charts.size(), 0);
  for (std::size_t c = 0; c < map.charts.size(); ++c) {
    const Chart& chart = map.charts[c];
    if (chart.sign == 0) continue;
    const int u = (chart.axis + 1) % 3, v = (chart.axis + 2) % 3;
    double area = 0;
    for (int t : chart.triangles) {
      const Vec3& origin = cuts.image[mesh.triangles[t][0]];
      const Vec3 a = cuts.image[mesh.triangles[t][1]] - origin, b = cuts.image[mesh.triangles[t][2]] - origin;
      area += (a[u] * b[v] - a[v] * b[u]) / 2;
    }
    const double extent = cuts.tolerance / kBlocksTuning.same_plane;
    cuts.collapsed[c] = std::abs(area) <= kBlocksTuning.no_area * extent * extent;
    // A label can contradict the map, which alone says where the solid is.
    cuts.sign[c] = area > 0 ? 1 : -1;
  }
}

/// Finds the components of all planes' preimages that touch a chart node, tet by tet.
class SheetFinder {
 public:
  SheetFinder(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, SheetCuts& cuts)
      : mesh_(mesh), map_(map), topology_(topology), cuts_(cuts), sheet_of_(mesh.tets.size(), -1) {}

  void run(const Monitor& monitor) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::vector<int>> charts_of_plane(cuts_.planes[axis].size());
      for (int c = 0; c < static_cast<int>(map_.charts.size()); ++c) {
        if (map_.charts[c].axis == axis) charts_of_plane[cuts_.chart_plane[c]].push_back(c);
      }
      for (int plane = 0; plane < static_cast<int>(charts_of_plane.size()); ++plane) {
        monitor.check();
        for (int c : charts_of_plane[plane]) {
          if (!cuts_.collapsed[c]) seed(axis, plane, c);
        }
        for (int t = 0; cuts_.all && t < static_cast<int>(mesh_.tets.size()); ++t) {
          if (sheet_of_[t] < 0 && crosses(mesh_.tets[t], std::array{0, 1, 2, 3}, axis, cuts_.planes[axis][plane])) flood(t, axis, plane);
        }
        for (std::size_t i = plane_begin_; i < passed_.size(); ++i) sheet_of_[passed_[i].first] = -1;
        plane_begin_ = passed_.size();
      }
    }
    finish();
  }

 private:
  template <class Nodes>
  bool crosses(const Tet& tet, const Nodes& nodes, int axis, double value) const {
    bool below = false, above = false;
    for (int k : nodes) (cuts_.image[tet[k]][axis] <= value ? below : above) = true;
    return below && above;
  }

  void seed(int axis, int plane, int chart) {
    const double value = cuts_.planes[axis][plane];
    for (int node : map_.charts[chart].nodes) {
      for (int i = topology_.node_tets_first[node]; i < topology_.node_tets_first[node + 1]; ++i) {
        const int t = topology_.node_tets[i];
        if (!crosses(mesh_.tets[t], std::array{0, 1, 2, 3}, axis, value)) continue;
        if (sheet_of_[t] < 0) flood(t, axis, plane);
        touches_.push_back({sheet_of_[t], chart});
      }
    }
  }

  void flood(int start, int axis, int plane) {
    const double value = cuts_.planes[axis][plane];
    const int sheet = raw_sheets_++;
    const auto visit = [&](int t) {
      sheet_of_[t] = sheet;
      passed_.push_back({t, {axis, plane, sheet}});
    };
    std::size_t next = passed_.size();
    visit(start);
    for (; next < passed_.size(); ++next) {
      const int t = passed_[next].first;
      for (int f = 0; f < 4; ++f) {
        const int n = topology_.neighbours[t][f];
        if (n >= 0 && sheet_of_[n] < 0 && crosses(mesh_.tets[t], kTetFacets[f], axis, value)) visit(n);
      }
    }
  }

  /// Joins what a boundary chart connects, gives unknowns, and sorts the cuts by tet.
  void finish() {
    const int chart_count = static_cast<int>(map_.charts.size());
    std::sort(touches_.begin(), touches_.end());
    touches_.erase(std::unique(touches_.begin(), touches_.end()), touches_.end());
    UnionFind joined(raw_sheets_ + map_.charts.size());  // raw sheets, then boundary charts
    std::vector<std::array<int, 3>> chart_at(mesh_.points.size(), {-1, -1, -1});
    for (int c = 0; c < chart_count; ++c) {
      const Chart& chart = map_.charts[c];
      if (chart.sign == 0 || cuts_.collapsed[c]) continue;
      for (int node : chart.nodes) {
        int& at = chart_at[node][chart.axis];
        if (at < 0) at = c;
        joined.unite(raw_sheets_ + at, raw_sheets_ + c);
      }
    }
    for (auto [sheet, chart] : touches_) {
      if (map_.charts[chart].sign != 0) joined.unite(sheet, raw_sheets_ + chart);
    }
    std::vector<int> number(raw_sheets_ + map_.charts.size(), -1);  // per representative
    const auto sheet_number = [&](int item, int axis) {
      int& n = number[joined.find(item)];
      if (n < 0) {
        n = static_cast<int>(cuts_.sheets.size());
        cuts_.sheets.push_back({axis, -1, {}});
      }
      return n;
    };
    std::vector<int> raw_number(raw_sheets_, -1);
    for (auto& [tet, cut] : passed_) {
      const int number_here = sheet_number(cut.sheet, cut.axis);
      raw_number[cut.sheet] = number_here;
      cut.sheet = number_here;
    }
    cuts_.chart_sheet.assign(chart_count, -1);
    for (int c = 0; c < chart_count; ++c) {
      const Chart& chart = map_.charts[c];
      if (chart.sign != 0 && !cuts_.collapsed[c]) {
        cuts_.chart_sheet[c] = sheet_number(raw_sheets_ + c, chart.axis);
        cuts_.sheets[cuts_.chart_sheet[c]].charts.push_back(c);
        continue;
      }
      for (int node : chart.nodes) {
        if (chart_at[node][chart.axis] < 0) continue;
        cuts_.sheets[sheet_number(raw_sheets_ + chart_at[node][chart.axis], chart.axis)].charts.push_back(c);
      }
    }
    for (auto [sheet, chart] : touches_) cuts_.sheets[raw_number[sheet]].charts.push_back(chart);
    UnionFind same(map_.charts.size());
    for (Sheet& sheet : cuts_.sheets) {
      std::sort(sheet.charts.begin(), sheet.charts.end());
      sheet.charts.erase(std::unique(sheet.charts.begin(), sheet.charts.end()), sheet.charts.end());
      for (int c : sheet.charts) same.unite(sheet.charts.front(), c);
    }
    cuts_.unknown.assign(chart_count, -1);
    for (Sheet& sheet : cuts_.sheets) {
      if (sheet.charts.empty()) continue;
      sheet.unknown = same.find(sheet.charts.front());
      for (int c : sheet.charts) cuts_.unknown[c] = sheet.unknown;
    }
    cuts_.first.assign(mesh_.tets.size() + 1, 0);
    for (const auto& item : passed_) ++cuts_.first[item.first + 1];
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) cuts_.first[t + 1] += cuts_.first[t];
    cuts_.cuts.resize(passed_.size());
    auto at = cuts_.first;
    for (const auto& [tet, cut] : passed_) cuts_.cuts[at[tet]++] = cut;  // found by ascending axis and plane
  }

  const TetMesh& mesh_;
  const PolycuboidMap& map_;
  const TetTopology& topology_;
  SheetCuts& cuts_;
  std::vector<int> sheet_of_;  ///< per tet on the plane at hand
  std::vector<std::pair<int, Cut>> passed_;
  std::size_t plane_begin_ = 0;
  int raw_sheets_ = 0;
  std::vector<std::pair<int, int>> touches_;  ///< sheet, chart
};

}  // namespace

SheetCuts find_sheets(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, bool all, const Monitor& monitor) {
  SheetCuts cuts;
  cuts.all = all;
  find_planes(map, cuts);
  find_signs(mesh, map, cuts);
  SheetFinder(mesh, map, topology, cuts).run(monitor);
  return cuts;
}

}  // namespace polycube
