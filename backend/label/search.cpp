#include "label/search.h"

#include <algorithm>
#include <set>

#include "core/parallel.h"
#include "label/graph_cut.h"
#include "label/tuning.h"

namespace polycube {
namespace {

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
  moves.reserve(unique.size());
  for (const auto& [set, l] : unique) moves.push_back({set, l});
  return moves;
}

}  // namespace

double region_energy(const RegionGraph& g, const std::vector<int>& label) {
  double sum = 0;
  for (std::size_t r = 0; r < g.regions.size(); ++r) sum += g.regions[r].data[label[r]];
  for (const Arc& a : g.arcs) {
    if (label[a.left] != label[a.right]) sum += a.weight * a.length;
  }
  return sum;
}

std::vector<int> repair(const RegionGraph& graph, const std::vector<Vec3>& points, std::vector<int> label, double noise, double weight, int threads,
                        const Monitor& monitor) {
  const auto near = adjacency(graph);
  const ViolationFinder finder(graph, points, noise);
  Violations violations = finder.find(label);
  double current = weight * violations.score + region_energy(graph, label);
  for (int step = 0; step < kLabelTuning.max_moves && violations.score > 0; ++step) {
    monitor.check();
    const std::vector<Move> moves = moves_near(graph, violations, near, label);
    const double enough = current * (1 - 1e-12) - 1e-9;
    // A move's energy bounds its cost from below: each thread leaves out what cannot be its best.
    struct Best {
      double cost;
      int move = -1;
    };
    threads = std::max(threads, 1);
    std::vector<Best> found(static_cast<std::size_t>(threads), {enough});
    for_chunks(threads, 1, threads, [&](int thread, int, int) {
      Best& best = found[thread];
      std::vector<int> next = label;
      for (int i = thread; i < static_cast<int>(moves.size()); i += threads) {
        const Move& m = moves[i];
        if (std::any_of(m.regions.begin(), m.regions.end(), [&](int r) { return graph.regions[r].data[m.label] >= kForbidden; })) continue;
        for (int r : m.regions) next[r] = m.label;
        const double energy = region_energy(graph, next);
        if (energy < best.cost) {
          const double cost = weight * finder.score(next) + energy;
          if (cost < best.cost) best = {cost, i};
        }
        for (int r : m.regions) next[r] = label[r];
      }
    });
    // The first of equals, whichever thread found it.
    const Best best =
        *std::min_element(found.begin(), found.end(), [](const Best& a, const Best& b) { return std::pair(a.cost, a.move) < std::pair(b.cost, b.move); });
    if (best.move < 0) break;
    for (int r : moves[best.move].regions) label[r] = moves[best.move].label;
    violations = finder.find(label);
    current = weight * violations.score + region_energy(graph, label);
  }
  return label;
}

}  // namespace polycube
