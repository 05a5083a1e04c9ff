#include "quantize/monotone.h"

#include <algorithm>

#include "core/hexahedron.h"

namespace polycube {
namespace {

/// Direction along v and w of the four octants with +u; the other four are the same paths backwards.
constexpr std::array<std::array<int, 3>, 4> kOctants{{{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}}};

/// Two vertices on different charts of an axis from which a vertex can be reached: enough to find a third chart different from one of them.
struct Sources {
  std::array<int, 2> vertex{-1, -1};
};

/// Indices sorted by key (from 0, below `keys`), equal ones in their order: linear, unlike a sort.
std::vector<int> order_by(const std::vector<int>& key, int keys) {
  std::vector<int> first(static_cast<std::size_t>(keys) + 1, 0), order(key.size());
  for (int k : key) ++first[k + 1];
  for (int k = 0; k < keys; ++k) first[k + 1] += first[k];
  for (int i = 0; i < static_cast<int>(key.size()); ++i) order[first[key[i]]++] = i;
  return order;
}

/// Without repetitions; a vertex has few edges, so all is sorted by their lower end first.
std::vector<MonotonePaths::Edge> distinct(const std::vector<MonotonePaths::Edge>& all, int vertices) {
  std::vector<int> from(all.size());
  for (std::size_t e = 0; e < all.size(); ++e) from[e] = all[e].from;
  std::vector<MonotonePaths::Edge> edges;
  std::size_t begin = 0;  // of the edges of the present vertex
  for (int e : order_by(from, vertices)) {
    if (begin < edges.size() && edges[begin].from != all[e].from) begin = edges.size();
    if (std::find(edges.begin() + static_cast<std::ptrdiff_t>(begin), edges.end(), all[e]) == edges.end()) edges.push_back(all[e]);
  }
  return edges;
}

}  // namespace

MonotonePaths::MonotonePaths(const BlockComplex& complex, const PolycuboidMap& map, const QuantizeProblem& problem, bool features) {
  on_chart_.assign(complex.vertex_count, 0);
  unknown_.resize(complex.vertex_count);
  for (int v = 0; v < complex.vertex_count; ++v) {
    for (int d = 0; d < 3; ++d) unknown_[v][d] = problem.number[complex.vertex_charts[v][d]];
  }
  // Of a side inside, the block behind it has the edges as well: those of its far sides and of the boundary are enough.
  std::vector<Edge> all;
  all.reserve(12 * complex.blocks.size());
  for (const Block& block : complex.blocks) {
    for (int side = 0; side < 6; ++side) {
      if (block.neighbours[side] >= 0) continue;
      for (int k : kHexFaces[side]) on_chart_[block.corners[k]] |= static_cast<char>(1 << (side / 2));
    }
    for (const auto& [i, j] : kHexEdges) {
      int axis = 0;
      while (kCornerCoordinates[i][axis] == kCornerCoordinates[j][axis]) ++axis;
      bool behind = false;
      for (int d = 0; d < 3; ++d) behind |= d != axis && kCornerCoordinates[i][d] == 0 && block.neighbours[low_side(d)] >= 0;
      if (behind) continue;
      const bool forward = kCornerCoordinates[i][axis] == 0;
      all.push_back(
          {axis, problem.number[block.charts[axis][0]], problem.number[block.charts[axis][1]], block.corners[forward ? i : j], block.corners[forward ? j : i]});
    }
  }
  edges_ = distinct(all, complex.vertex_count);
  if (features) {
    for (std::size_t c = 0; c < complex.feature_vertices.size(); ++c) {
      for (int v : complex.feature_vertices[c]) on_chart_[v] |= static_cast<char>(1 << map.charts[c].axis);
    }
  }

  // Positions by rank of the chart's value: every edge goes up by at least one.
  std::array<std::vector<int>, 3> rank;
  int ranks = 0;
  for (int d = 0; d < 3; ++d) {
    const auto& charts = problem.axes[d].charts;
    std::vector<double> values;
    values.reserve(charts.size());
    for (int c : charts) values.push_back(map.charts[c].value);
    std::sort(values.begin(), values.end());
    for (int c : charts) {
      rank[d].push_back(static_cast<int>(std::lower_bound(values.begin(), values.end(), map.charts[c].value) - values.begin()));
    }
    ranks += static_cast<int>(charts.size());
  }
  std::vector<int> key(edges_.size());
  for (std::size_t o = 0; o < kOctants.size(); ++o) {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const int from = kOctants[o][edges_[e].axis] > 0 ? edges_[e].from : edges_[e].to;
      key[e] = ranks;
      for (int d = 0; d < 3; ++d) key[e] += kOctants[o][d] * rank[d][unknown_[from][d]];
    }
    order_[o] = order_by(key, 2 * ranks + 1);
  }
}

std::vector<Cut2> MonotonePaths::violations(const std::array<const std::vector<int>*, 3>& values) const {
  std::vector<char> zero(edges_.size());
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto& l = *values[edges_[e].axis];
    zero[e] = l[edges_[e].high] == l[edges_[e].low];
  }
  std::vector<Cut2> found;
  std::vector<std::array<Sources, 3>> sources;
  for (std::size_t o = 0; o < kOctants.size(); ++o) {
    sources.assign(unknown_.size(), {});
    const auto add = [&](Sources& s, int vertex, int d) {
      if (vertex < 0 || s.vertex[1] >= 0) return;
      if (s.vertex[0] < 0) {
        s.vertex[0] = vertex;
      } else if (unknown_[s.vertex[0]][d] != unknown_[vertex][d]) {
        s.vertex[1] = vertex;
      }
    };
    const auto report = [&](int from, int to) {
      Cut2 cut;
      for (int d = 0; d < 3; ++d) {
        const int a = unknown_[from][d], b = unknown_[to][d];
        if (a == b) continue;
        cut.alternatives[cut.count++] = kOctants[o][d] > 0 ? Cut2::Alternative{d, a, b} : Cut2::Alternative{d, b, a};
      }
      found.push_back(cut);
    };
    for (int e : order_[o]) {
      if (!zero[e]) continue;
      const Edge& edge = edges_[e];
      const bool forward = kOctants[o][edge.axis] > 0;
      const int from = forward ? edge.from : edge.to, to = forward ? edge.to : edge.from;
      for (int d = 0; d < 3; ++d) {
        if (on_chart_[from] >> d & 1) add(sources[from][d], from, d);
        for (int s : sources[from][d].vertex) {
          if (s < 0) continue;
          if ((on_chart_[to] >> d & 1) && unknown_[s][d] != unknown_[to][d]) report(s, to);
          add(sources[to][d], s, d);
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace polycube
