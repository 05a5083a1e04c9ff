#include "hex/hex.h"

#include <algorithm>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/union_find.h"
#include "hex/connectivity.h"
#include "hex/geometry.h"

namespace polycube {
namespace {

std::array<int, 4> sorted(std::array<int, 4> v) {
  std::sort(v.begin(), v.end());
  return v;
}

}  // namespace

HexComplex build_hexes(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const Quantization& quantization, const Monitor& monitor,
                       const Spacing& spacing) {
  monitor.progress("hex", 0);
  if (quantization.value.size() != map.charts.size()) throw InvalidInput("the quantization does not have one integer per chart");
  Connectivity connectivity = connect(map, blocks, quantization.value, spacing);
  const HexReport report = check(connectivity.hexes, map, blocks);
  if (!report.lost_charts.empty()) {
    std::vector<CadRef> entities;
    std::string names;
    for (int c : report.lost_charts) {
      names += (names.empty() ? " " : ", ") + std::to_string(c);
      for (int t : map.charts[c].triangles) {
        if (t < static_cast<int>(tets.triangle_face.size())) entities.push_back({2, tets.triangle_face[t]});
      }
    }
    std::sort(entities.begin(), entities.end());
    entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
    throw StageFailed("hex", "charts without a quad:" + names, entities);
  }
  if (!report.good(euler_characteristic(tets.triangles))) {
    throw StageFailed("hex", "the hexahedra do not form a conforming mesh with the topology of the solid");
  }
  monitor.progress("hex", 0.2);
  place_nodes(tets, map, blocks, connectivity, monitor);
  monitor.progress("hex", 1);
  return std::move(connectivity.hexes);
}

HexReport check(const HexComplex& complex, const PolycuboidMap& map, const BlockComplex& blocks) {
  HexReport report;
  report.hexes = static_cast<int>(complex.mesh.hexes.size());
  struct Face {
    std::array<int, 4> nodes;
    int hex;  ///< -1 for a boundary quad
  };
  std::vector<Face> faces;
  faces.reserve(6 * complex.mesh.hexes.size() + complex.quads.size());
  for (int h = 0; h < report.hexes; ++h) {
    const Hex& hex = complex.mesh.hexes[h];
    auto nodes = hex;
    std::sort(nodes.begin(), nodes.end());
    report.repeated_nodes += std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end();
    for (const auto& f : kHexFaces) faces.push_back({sorted({hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]}), h});
  }
  for (const Quad& q : complex.quads) faces.push_back({sorted(q), -1});
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.hex < b.hex; });
  UnionFind cells(complex.mesh.hexes.size());
  for (std::size_t i = 0; i < faces.size();) {
    std::size_t j = i;
    int hexes = 0, quads = 0;
    for (; j < faces.size() && faces[j].nodes == faces[i].nodes; ++j) ++(faces[j].hex < 0 ? quads : hexes);
    report.overfull_faces += hexes > 2;
    report.stray_quads += quads != (hexes == 1 ? 1 : 0);
    if (hexes == 2 && quads == 0) cells.unite(faces[i].hex, faces[i + 1].hex);
    i = j;
  }
  for (int h = 0; h < report.hexes; ++h) report.components += cells.find(h) == h;

  std::vector<std::array<int, 3>> edges;    // ends ascending, quad
  std::vector<std::array<int, 2>> corners;  // node, quad
  for (int q = 0; q < static_cast<int>(complex.quads.size()); ++q) {
    for (int k = 0; k < 4; ++k) {
      const int a = complex.quads[q][k], b = complex.quads[q][(k + 1) % 4];
      edges.push_back({std::min(a, b), std::max(a, b), q});
      corners.push_back({a, q});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(corners.begin(), corners.end());
  const auto corner = [&](int node, int quad) {
    return static_cast<int>(std::lower_bound(corners.begin(), corners.end(), std::array{node, quad}) - corners.begin());
  };
  UnionFind fans(corners.size());  // quads at a node, joined across the edges at that node
  int distinct_edges = 0, sharing = 0;
  const std::array<int, 3>* previous = nullptr;
  for (const auto& edge : edges) {
    if (previous == nullptr || (*previous)[0] != edge[0] || (*previous)[1] != edge[1]) {
      report.nonmanifold_edges += previous != nullptr && sharing != 2;
      ++distinct_edges;
      sharing = 0;
    } else {
      for (int end : {0, 1}) fans.unite(corner(edge[end], (*previous)[2]), corner(edge[end], edge[2]));
    }
    ++sharing;
    previous = &edge;
  }
  report.nonmanifold_edges += previous != nullptr && sharing != 2;
  int boundary_nodes = 0;
  for (std::size_t i = 0; i < corners.size();) {
    std::size_t j = i;
    int fan_count = 0;
    for (; j < corners.size() && corners[j][0] == corners[i][0]; ++j) fan_count += fans.find(static_cast<int>(j)) == static_cast<int>(j);
    ++boundary_nodes;
    report.nonmanifold_nodes += fan_count != 1;
    i = j;
  }
  report.euler = boundary_nodes - distinct_edges + static_cast<int>(complex.quads.size());
  std::vector<char> present(map.charts.size(), 0);
  for (int c : complex.quad_chart) {
    if (c >= 0) present[c] = 1;
  }
  for (std::size_t c = 0; c < map.charts.size(); ++c) {
    const bool collapsed = std::binary_search(blocks.collapsed.begin(), blocks.collapsed.end(), static_cast<int>(c));
    if (map.charts[c].sign != 0 && !collapsed && !present[c]) report.lost_charts.push_back(static_cast<int>(c));
  }
  return report;
}

}  // namespace polycube
