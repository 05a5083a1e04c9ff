#include "refine/region.h"

#include <algorithm>

#include "core/hexahedron.h"
#include "core/sorted.h"
#include "core/union_find.h"
#include "refine/refine.h"

namespace polycube {
namespace {

// Edges of a cell along each of its directions.
constexpr std::array<std::array<std::array<int, 2>, 4>, 3> kParallel{{
    {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}},
    {{{1, 2}, {0, 3}, {5, 6}, {4, 7}}},
    {{{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
}};

}  // namespace

CornerSet marked_corners(const Hex& hex, const std::vector<char>& marked) {
  CornerSet set = 0;
  for (int c = 0; c < 8; ++c) {
    if (marked[hex[c]]) set = static_cast<CornerSet>(set | (1 << c));
  }
  return set;
}

std::vector<char> marked_nodes(const HexMesh& mesh, const HexTopology& topology, const std::vector<char>& cells, const Monitor& monitor) {
  std::array<CornerSet, 256> wanted;
  for (int set = 0; set < 256; ++set) wanted[static_cast<std::size_t>(set)] = with_template(static_cast<CornerSet>(set));
  std::vector<char> marked(mesh.points.size(), 0);
  std::vector<int> pending;  // nodes whose hexes are to be looked at
  const auto mark = [&](int node) {
    if (marked[node]) return;
    marked[node] = 1;
    pending.push_back(node);
  };
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (!cells[h]) continue;
    for (const int node : mesh.hexes[h]) mark(node);
  }
  for (long long done = 0; !pending.empty(); ++done) {
    if (done % 100'000 == 0) monitor.check();
    const int node = pending.back();
    pending.pop_back();
    for (int i = topology.node_first[node]; i < topology.node_first[node + 1]; ++i) {
      const Hex& hex = mesh.hexes[topology.node_hexes[i]];
      const CornerSet more = wanted[marked_corners(hex, marked)];
      for (int c = 0; c < 8; ++c) {
        if ((more >> c) & 1) mark(hex[c]);
      }
    }
  }
  return marked;
}

std::vector<std::array<bool, 3>> divided_directions(const HexMesh& mesh, const std::vector<Segment>& along) {
  std::vector<std::array<bool, 3>> result(mesh.hexes.size(), {along.empty(), along.empty(), along.empty()});
  if (along.empty()) return result;
  std::vector<Segment> edges;
  edges.reserve(12 * mesh.hexes.size());
  for (const Hex& hex : mesh.hexes) {
    for (const auto& [c, d] : kHexEdges) edges.push_back(sorted(Segment{hex[c], hex[d]}));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto index = [&](int a, int b) { return static_cast<int>(std::lower_bound(edges.begin(), edges.end(), sorted(Segment{a, b})) - edges.begin()); };
  UnionFind sheets(edges.size());
  for (const Hex& hex : mesh.hexes) {
    for (const auto& parallel : kParallel) {
      const int first = index(hex[parallel[0][0]], hex[parallel[0][1]]);
      for (int k = 1; k < 4; ++k) sheets.unite(first, index(hex[parallel[k][0]], hex[parallel[k][1]]));
    }
  }
  std::vector<char> crossed(edges.size(), 0);
  for (const Segment& s : along) crossed[sheets.find(index(s[0], s[1]))] = 1;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    for (int d = 0; d < 3; ++d) {
      const auto& [c, e] = kParallel[d][0];
      result[h][d] = crossed[sheets.find(index(mesh.hexes[h][c], mesh.hexes[h][e]))];
    }
  }
  return result;
}

std::vector<char> with_neighbours(const HexMesh& mesh, const std::vector<char>& cells) {
  std::vector<char> near(mesh.points.size(), 0), result(mesh.hexes.size(), 0);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (!cells[h]) continue;
    for (const int node : mesh.hexes[h]) near[node] = 1;
  }
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    result[h] = std::any_of(mesh.hexes[h].begin(), mesh.hexes[h].end(), [&](int node) { return near[node] != 0; });
  }
  return result;
}

std::vector<char> cells_at(const HexMesh& mesh, const Association& association, const CadRef& entity) {
  if (entity.dim == 3) return std::vector<char>(mesh.hexes.size(), 1);
  // A cell is there if it has all nodes of one of these.
  std::vector<std::vector<int>> places;
  if (entity.dim == 0) {
    for (std::size_t v = 0; v < association.point_cad.size(); ++v) {
      if (association.point_cad[v] == entity) places.push_back({static_cast<int>(v)});
    }
  }
  for (std::size_t s = 0; s < association.segments.size() && entity.dim == 1; ++s) {
    if (association.segment_edge[s] == entity.id) places.push_back({association.segments[s].begin(), association.segments[s].end()});
  }
  for (std::size_t q = 0; q < association.quads.size() && entity.dim == 2; ++q) {
    const auto& patch = association.patches[association.quad_patch[q]];
    if (std::binary_search(patch.begin(), patch.end(), entity.id)) places.push_back({association.quads[q].begin(), association.quads[q].end()});
  }
  std::vector<std::vector<int>> at(mesh.points.size());  // per node the places that it begins
  for (std::size_t p = 0; p < places.size(); ++p) at[places[p].front()].push_back(static_cast<int>(p));
  std::vector<char> result(mesh.hexes.size(), 0);
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    for (const int node : mesh.hexes[h]) {
      for (const int p : at[node]) {
        const auto& place = places[p];
        if (std::all_of(place.begin(), place.end(), [&](int n) { return corner_of(mesh.hexes[h], n) >= 0; })) result[h] = 1;
      }
    }
  }
  return result;
}

}  // namespace polycube
