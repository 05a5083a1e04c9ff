#include "label/search.h"

#include <algorithm>
#include <set>

#include "label/graph_cut.h"

namespace polycube {
namespace {

constexpr int kMaxMoves = 400;

double region_energy(const RegionGraph& g, const std::vector<int>& label) {
  double sum = 0;
  for (std::size_t r = 0; r < g.regions.size(); ++r) sum += g.regions[r].data[label[r]];
  for (const Arc& a : g.arcs) {
    if (label[a.left] != label[a.right]) sum += a.weight * a.length;
  }
  return sum;
}

struct Move {
  std::vector<int> regions;
  int label;
};

std::vector<std::set<int>> adjacency(const RegionGraph& g) {
  std::vector<std::set<int>> result(g.regions.size());
  for (const Arc& a : g.arcs) {
    if (a.left == a.right) continue;
    result[a.left].insert(a.right);
    result[a.right].insert(a.left);
  }
  return result;
}

std::vector<int> chart_of(int region, const std::vector<std::set<int>>& near, const std::vector<int>& label) {
  std::vector<int> chart{region};
  std::set<int> seen{region};
  for (std::size_t i = 0; i < chart.size(); ++i) {
    for (int n : near[chart[i]]) {
      if (label[n] == label[region] && seen.insert(n).second) chart.push_back(n);
    }
  }
  std::sort(chart.begin(), chart.end());
  return chart;
}

std::vector<Move> moves_near(const RegionGraph& g, const Violations& violations, const std::vector<std::set<int>>& near, const std::vector<int>& label) {
  const std::vector<int>& regions = violations.regions;
  std::set<int> around(regions.begin(), regions.end());
  for (int r : regions) around.insert(near[r].begin(), near[r].end());
  std::set<std::pair<std::vector<int>, int>> unique;
  for (int r : around) {
    for (int l = 0; l < 6; ++l) {
      if (l != label[r]) unique.insert({{r}, l});
    }
    const std::vector<int> chart = chart_of(r, near, label);
    for (int l = 0; l < 6; ++l) {
      if (l != label[r] && chart.size() > 1) unique.insert({chart, l});
    }
    for (int n : near[r]) {
      if (n < r) continue;
      for (int l = 0; l < 6; ++l) {
        if (l != label[r] && l != label[n]) unique.insert({{r, n}, l});
      }
    }
  }
  // The tip of a pyramid becomes flat when all that meets there takes one label.
  for (int c : violations.corners) {
    std::set<int> star;
    for (int d : g.junctions[c].darts) star.insert(dart_left(g, d));
    for (int l = 0; l < 6; ++l) unique.insert({{star.begin(), star.end()}, l});
  }
  std::vector<Move> moves;
  for (const auto& [set, l] : unique) moves.push_back({set, l});
  return moves;
}

}  // namespace

std::vector<int> repair(const RegionGraph& graph, const std::vector<Vec3>& points, std::vector<int> label, double noise, double weight,
                        const Monitor& monitor) {
  const auto near = adjacency(graph);
  const auto cost = [&](const std::vector<int>& l, Violations* v) {
    Violations found = find_violations(graph, points, l, noise);
    const double c = weight * found.score + region_energy(graph, l);
    if (v) *v = std::move(found);
    return c;
  };
  Violations violations;
  double current = cost(label, &violations);
  for (int step = 0; step < kMaxMoves && violations.score > 0; ++step) {
    monitor.check();
    const Move* best = nullptr;
    double best_cost = current * (1 - 1e-12) - 1e-9;
    const std::vector<Move> moves = moves_near(graph, violations, near, label);
    for (const Move& m : moves) {
      if (std::any_of(m.regions.begin(), m.regions.end(), [&](int r) { return graph.regions[r].data[m.label] >= kForbidden; })) continue;
      std::vector<int> next = label;
      for (int r : m.regions) next[r] = m.label;
      const double c = cost(next, nullptr);
      if (c >= best_cost) continue;
      best_cost = c;
      best = &m;
    }
    if (!best) break;
    for (int r : best->regions) label[r] = best->label;
    current = cost(label, &violations);
  }
  return label;
}

}  // namespace polycube
