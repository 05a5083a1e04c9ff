#include "label/order.h"

#include <algorithm>
#include <set>

#include "core/charts.h"
#include "core/union_find.h"
#include "label/validity.h"

namespace polycube {
namespace {

// +1: the chain rises along the axis all the way, -1: it falls, 0: neither.
int course(const std::vector<Vec3>& points, const std::vector<int>& chain, int axis, double noise) {
  const int sign = points[chain.back()][axis] >= points[chain.front()][axis] ? 1 : -1;
  double furthest = sign * points[chain.front()][axis];
  for (int n : chain) {
    const double x = sign * points[n][axis];
    if (x < furthest - noise) return 0;
    furthest = std::max(furthest, x);
  }
  return std::abs(points[chain.back()][axis] - points[chain.front()][axis]) > noise ? sign : 0;
}

// The way from `from` back to itself with fewest steps; empty where there is none.
std::vector<int> shortest_loop(const std::vector<std::set<int>>& above, int from) {
  std::vector<int> before(above.size(), -1), queue{from};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (int next : above[queue[i]]) {
      if (next == from) {
        std::vector<int> loop;
        for (int at = queue[i]; at != from; at = before[at]) loop.push_back(at);
        loop.push_back(from);
        std::reverse(loop.begin(), loop.end());
        return loop;
      }
      if (before[next] >= 0) continue;
      before[next] = queue[i];
      queue.push_back(next);
    }
  }
  return {};
}

}  // namespace

RisingLoop find_rising_loop(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& region_label, double noise) {
  // Of each axis, at each junction.
  std::vector<std::array<int, 3>> chart_at(graph.junctions.size(), {-1, -1, -1});
  UnionFind planes(graph.regions.size());
  for (std::size_t j = 0; j < graph.junctions.size(); ++j) {
    for (int d : graph.junctions[j].darts) {
      const int chart = dart_left(graph, d);
      int& first = chart_at[j][label_axis(region_label[chart])];
      if (first >= 0) planes.unite(first, chart);
      first = chart;
    }
  }
  std::vector<std::set<int>> above(graph.regions.size());
  for (const Arc& arc : graph.arcs) {
    const int a = label_axis(region_label[arc.left]), b = label_axis(region_label[arc.right]);
    if (a == b || arc.start < 0) continue;
    const int axis = 3 - a - b;
    const int from = chart_at[arc.start][axis], to = chart_at[arc.end][axis];
    const int sign = from < 0 || to < 0 ? 0 : course(points, arc.nodes, axis, noise);
    if (sign == 0) continue;
    const int low = planes.find(sign > 0 ? from : to), high = planes.find(sign > 0 ? to : from);
    above[low].insert(high);
  }
  RisingLoop best;
  for (int r = 0; r < static_cast<int>(above.size()); ++r) {
    const std::vector<int> loop = shortest_loop(above, r);
    if (!loop.empty() && (best.charts.empty() || loop.size() < best.charts.size())) best = {label_axis(region_label[r]), loop};
  }
  return best;
}

RisingLoop find_rising_loop(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels) {
  const ChartGraph c = chart_graph(mesh, frame, labels);
  return find_rising_loop(c.graph, c.points, c.label, c.noise);
}

}  // namespace polycube
