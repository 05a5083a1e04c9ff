#include "pad/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "pad/sheet.h"

namespace polycube {

namespace {

constexpr double kPi = std::numbers::pi;
// Across an edge wider than this a layer cannot end: its one cell there would be too flat.
constexpr double kWidestEnd = 130 * kPi / 180;
// What a padded quad costs. A bore's four lines of three cells (60 degrees each) are not worth a layer; one line of one cell (180 degrees) is.
constexpr double kQuadPrice = 0.15;

// Smooth regions of the boundary and what it costs to pad them.
struct RegionGraph {
  struct Link {
    int r, s;
    std::array<double, 4> cost;  // neither, r, s, both
  };
  std::vector<int> region;             // per quad
  std::vector<double> own;             // per region: cost of padding less cost of not padding
  std::vector<Link> links;
  std::vector<std::vector<int>> links_of;

  int size() const { return static_cast<int>(own.size()); }
  double change(const std::vector<char>& chosen, int r) const {
    double delta = chosen[r] ? -own[r] : own[r];
    for (int l : links_of[r]) {
      const Link& link = links[l];
      const int state = (chosen[link.r] ? 1 : 0) + (chosen[link.s] ? 2 : 0);
      delta += link.cost[state ^ (link.r == r ? 1 : 2)] - link.cost[state];
    }
    return delta;
  }
  double total(const std::vector<char>& chosen) const {
    double sum = 0;
    for (int r = 0; r < size(); ++r) sum += chosen[r] ? own[r] : 0;
    for (const Link& link : links) sum += link.cost[(chosen[link.r] ? 1 : 0) + (chosen[link.s] ? 2 : 0)];
    return sum;
  }
};

double both_cost(int hexes, double angle) { return angle_cost(2, angle) + angle_cost(hexes + 2, 2 * kPi); }
double one_cost(int hexes, double angle) { return angle_cost(1, angle) + angle_cost(hexes + 1, kPi); }

RegionGraph build_regions(const Association& association, const std::vector<BoundaryEdge>& edges, const std::vector<double>& angles) {
  const int quads = static_cast<int>(association.quads.size());
  std::vector<int> root(quads);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int x) {
    while (root[x] != x) x = root[x] = root[root[x]];
    return x;
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (angles[e] <= kWidestEnd) continue;
    const int x = find(edges[e].quads[0]), y = find(edges[e].quads[1]);
    root[std::max(x, y)] = std::min(x, y);
  }
  RegionGraph graph;
  graph.region.assign(quads, -1);
  for (int q = 0; q < quads; ++q) {
    const int r = find(q);
    if (r == q) {
      graph.region[q] = graph.size();
      graph.own.push_back(0);
    } else {
      graph.region[q] = graph.region[r];
    }
    graph.own[graph.region[q]] += kQuadPrice;
  }
  std::vector<RegionGraph::Link> links;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const int n = edges[e].hexes, r = graph.region[edges[e].quads[0]], s = graph.region[edges[e].quads[1]];
    const double none = angle_cost(n, angles[e]), both = both_cost(n, angles[e]);
    if (r == s) {
      graph.own[r] += both - none;
    } else {
      const double one = one_cost(n, angles[e]);
      links.push_back({std::min(r, s), std::max(r, s), {none, one, one, both}});
    }
  }
  std::stable_sort(links.begin(), links.end(), [](const auto& x, const auto& y) { return std::array{x.r, x.s} < std::array{y.r, y.s}; });
  graph.links_of.resize(graph.own.size());
  for (const auto& link : links) {
    if (!graph.links.empty() && graph.links.back().r == link.r && graph.links.back().s == link.s) {
      for (int k = 0; k < 4; ++k) graph.links.back().cost[k] += link.cost[k];
      continue;
    }
    graph.links_of[link.r].push_back(static_cast<int>(graph.links.size()));
    graph.links_of[link.s].push_back(static_cast<int>(graph.links.size()));
    graph.links.push_back(link);
  }
  return graph;
}

// Flips of one region or of two neighbours while the total falls.
void descend(const RegionGraph& graph, std::vector<char>& chosen) {
  constexpr double kGain = 1e-9;
  for (bool improved = true; improved;) {
    improved = false;
    for (int r = 0; r < graph.size(); ++r) {
      if (graph.change(chosen, r) < -kGain) {
        chosen[r] ^= 1;
        improved = true;
      }
    }
    for (const auto& link : graph.links) {
      const double first = graph.change(chosen, link.r);
      chosen[link.r] ^= 1;
      if (first + graph.change(chosen, link.s) < -kGain) {
        chosen[link.s] ^= 1;
        improved = true;
      } else {
        chosen[link.r] ^= 1;
      }
    }
  }
}

// Regions chosen from several starts; the best.
std::vector<char> search(const RegionGraph& graph) {
  std::vector<char> none(graph.own.size(), 0), all(graph.own.size(), 1), greedy(graph.own.size());
  for (int r = 0; r < graph.size(); ++r) greedy[r] = graph.own[r] < 0;
  for (auto* start : {&none, &greedy, &all}) descend(graph, *start);
  const std::vector<char>* best = &none;
  for (auto* other : {&greedy, &all}) {
    if (graph.total(*other) < graph.total(*best) - 1e-9) best = other;
  }
  return *best;
}

std::vector<char> quads_of(const RegionGraph& graph, const std::vector<char>& chosen) {
  std::vector<char> surface(graph.region.size());
  for (std::size_t q = 0; q < surface.size(); ++q) surface[q] = chosen[graph.region[q]];
  return surface;
}

}  // namespace

std::vector<char> choose_surface(const HexMesh& mesh, const Association& association, const std::vector<BoundaryEdge>& edges,
                                 const std::vector<double>& angles, const Monitor& monitor) {
  const RegionGraph graph = build_regions(association, edges, angles);
  std::vector<char> chosen = search(graph);
  std::vector<std::vector<int>> node_regions(mesh.points.size());
  for (std::size_t q = 0; q < association.quads.size(); ++q) {
    for (int node : association.quads[q]) node_regions[node].push_back(graph.region[q]);
  }
  // A layer that cannot be opened at a node takes in one more region there; with all regions it always can.
  while (std::find(chosen.begin(), chosen.end(), 1) != chosen.end()) {
    monitor.check();
    const SheetCut cut{std::vector<char>(mesh.hexes.size(), 1), quads_of(graph, chosen)};
    const auto obstacles = sheet_obstacles(mesh, association, cut);
    if (obstacles.empty()) break;
    bool extended = false;
    for (int node : obstacles) {
      int cheapest = -1;
      double least = std::numeric_limits<double>::infinity();
      for (int r : node_regions[node]) {
        const double delta = chosen[r] ? least : graph.change(chosen, r);
        if (delta < least) {
          least = delta;
          cheapest = r;
        }
      }
      if (cheapest < 0) continue;
      chosen[cheapest] = 1;
      extended = true;
    }
    if (!extended) return std::vector<char>(association.quads.size(), 0);
  }
  return quads_of(graph, chosen);
}

}  // namespace polycube
