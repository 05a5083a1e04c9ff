#include "pad/topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/hexahedron.h"

namespace polycube {

namespace {

struct Side {
  std::array<int, 4> nodes;  // sorted
  int id;                    // side, or -1 - quad
  friend bool operator<(const Side& x, const Side& y) { return std::tie(x.nodes, x.id) < std::tie(y.nodes, y.id); }
};

// All sides of hexes and all quads in their order. By the smallest node first, which is counted, not compared: few sides have the same one.
std::vector<Side> sides_by_nodes(const HexMesh& mesh, const std::vector<Quad>& quads) {
  const auto for_each = [&](const auto& visit) {
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
      for (int f = 0; f < 6; ++f) {
        std::array<int, 4> nodes;
        for (int k = 0; k < 4; ++k) nodes[k] = mesh.hexes[h][kHexFaces[f][k]];
        visit(nodes, static_cast<int>(6 * h) + f);
      }
    }
    for (std::size_t q = 0; q < quads.size(); ++q) visit(quads[q], -1 - static_cast<int>(q));
  };
  std::vector<int> first(mesh.points.size() + 1, 0);
  for_each([&](const std::array<int, 4>& nodes, int) { ++first[*std::min_element(nodes.begin(), nodes.end()) + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> next(first.begin(), first.end() - 1);
  std::vector<Side> sides(6 * mesh.hexes.size() + quads.size());
  for_each([&](std::array<int, 4> nodes, int id) {
    std::sort(nodes.begin(), nodes.end());
    sides[next[nodes[0]]++] = {nodes, id};
  });
  for (std::size_t v = 0; v + 1 < first.size(); ++v) std::sort(sides.begin() + first[v], sides.begin() + first[v + 1]);
  return sides;
}

}  // namespace

HexTopology build_topology(const HexMesh& mesh, const std::vector<Quad>& quads) {
  const int hex_count = static_cast<int>(mesh.hexes.size()), quad_count = static_cast<int>(quads.size());
  HexTopology topology;
  std::vector<Side> sides = sides_by_nodes(mesh, quads);
  topology.mate.assign(6 * mesh.hexes.size(), -1 - quad_count);
  topology.quad_side.assign(quads.size(), -1);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i, first_hex = i;
    while (j < sides.size() && sides[j].nodes == sides[i].nodes) ++j;
    while (first_hex < j && sides[first_hex].id < 0) ++first_hex;
    const std::size_t hexes = j - first_hex;
    if (hexes == 2) {
      topology.mate[sides[first_hex].id] = sides[first_hex + 1].id;
      topology.mate[sides[first_hex + 1].id] = sides[first_hex].id;
    } else if (hexes == 1 && first_hex > i) {
      topology.mate[sides[first_hex].id] = sides[first_hex - 1].id;
      topology.quad_side[-1 - sides[first_hex - 1].id] = sides[first_hex].id;
    } else if (hexes > 2) {
      topology.overfull.push_back(sides[first_hex].id);
    }
    i = j;
  }

  topology.node_first.assign(mesh.points.size() + 1, 0);
  for (const Hex& hex : mesh.hexes) {
    for (int node : hex) ++topology.node_first[node + 1];
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) topology.node_first[i + 1] += topology.node_first[i];
  topology.node_hexes.resize(8 * mesh.hexes.size());
  std::vector<int> cursor(topology.node_first.begin(), topology.node_first.end() - 1);
  for (int h = 0; h < hex_count; ++h) {
    for (int node : mesh.hexes[h]) topology.node_hexes[cursor[node]++] = h;
  }
  return topology;
}

std::vector<int> sides_at(const HexMesh& mesh, const HexTopology& topology, const Quad& quad) {
  std::vector<int> sides;
  for (int i = topology.node_first[quad[0]]; i < topology.node_first[quad[0] + 1]; ++i) {
    const int hex = topology.node_hexes[i];
    for (int f = 0; f < 6; ++f) {
      if (std::all_of(kHexFaces[f].begin(), kHexFaces[f].end(), [&](int c) { return std::find(quad.begin(), quad.end(), mesh.hexes[hex][c]) != quad.end(); }))
        sides.push_back(6 * hex + f);
    }
  }
  return sides;
}

int corner_of(const Hex& hex, int node) {
  for (int c = 0; c < 8; ++c) {
    if (hex[c] == node) return c;
  }
  return -1;
}

int other_face(const Hex& hex, int face, int a, int b) {
  for (int f = 0; f < 6; ++f) {
    if (f == face) continue;
    int found = 0;
    for (int c : kHexFaces[f]) found += hex[c] == a || hex[c] == b;
    if (found == 2) return f;
  }
  return -1;
}

std::vector<BoundaryEdge> boundary_edges(const HexMesh& mesh, const std::vector<Quad>& quads, const HexTopology& topology) {
  std::vector<std::array<int, 3>> halves;  // a, b, quad
  halves.reserve(4 * quads.size());
  for (int q = 0; q < static_cast<int>(quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) {
      const int a = quads[q][k], b = quads[q][(k + 1) % 4];
      halves.push_back({std::min(a, b), std::max(a, b), q});
    }
  }
  std::sort(halves.begin(), halves.end());
  std::vector<BoundaryEdge> edges;
  edges.reserve(halves.size() / 2);
  for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
    const auto [a, b, q] = halves[i];
    if (halves[i + 1][0] != a || halves[i + 1][1] != b) continue;
    BoundaryEdge edge{a, b, {q, halves[i + 1][2]}, 0};
    for (int side = topology.quad_side[q]; side >= 0;) {
      ++edge.hexes;
      const int hex = side / 6;
      side = topology.mate[6 * hex + other_face(mesh.hexes[hex], side % 6, a, b)];
    }
    edges.push_back(edge);
    ++i;
  }
  return edges;
}

int find_edge(const std::vector<BoundaryEdge>& edges, int a, int b) {
  const std::array wanted{std::min(a, b), std::max(a, b)};
  const auto it = std::lower_bound(edges.begin(), edges.end(), wanted, [](const BoundaryEdge& e, const std::array<int, 2>& key) {
    return std::array{e.a, e.b} < key;
  });
  return it != edges.end() && it->a == wanted[0] && it->b == wanted[1] ? static_cast<int>(it - edges.begin()) : -1;
}

}  // namespace polycube
