#include <algorithm>
#include <map>

#include "blocks/blocks.h"
#include "core/hexahedron.h"

namespace polycube {

BlockReport check(const BlockComplex& complex, const PolycuboidMap& map) {
  BlockReport report;
  report.blocks = static_cast<int>(complex.blocks.size());
  std::vector<char> present(map.charts.size(), 0);
  std::map<std::array<int, 2>, std::vector<int>> edges;  // charts of the sides there
  std::vector<char> on_boundary(complex.vertex_count, 0);
  for (int b = 0; b < report.blocks; ++b) {
    const Block& block = complex.blocks[b];
    for (int side = 0; side < 6; ++side) {
      const int n = block.neighbours[side], axis = side / 2;
      if (n >= 0) {
        const Block& other = complex.blocks[n];
        bool fits = other.neighbours[side ^ 1] == b;
        for (int d = 0; d < 3; ++d) {
          if (d == axis) {
            fits = fits && block.sheets[d][side % 2] == other.sheets[d][1 - side % 2];
          } else {
            fits = fits && block.sheets[d] == other.sheets[d];
          }
        }
        report.asymmetric_neighbours += !fits;
        continue;
      }
      ++report.boundary_quads;
      if (block.side_chart[side] >= 0) {
        present[block.side_chart[side]] = 1;
      } else {
        ++report.bare_sides;
      }
      for (int k = 0; k < 4; ++k) {
        const int u = block.corners[kHexFaces[side][k]], v = block.corners[kHexFaces[side][(k + 1) % 4]];
        edges[{std::min(u, v), std::max(u, v)}].push_back(block.side_chart[side]);
        on_boundary[u] = 1;
      }
    }
  }
  for (const auto& [edge, charts] : edges) {
    if (charts.size() == 2) continue;
    ++report.nonmanifold_edges;
    report.touching_charts.insert(report.touching_charts.end(), charts.begin(), charts.end());
  }
  std::sort(report.touching_charts.begin(), report.touching_charts.end());
  report.touching_charts.erase(std::unique(report.touching_charts.begin(), report.touching_charts.end()), report.touching_charts.end());
  report.euler = static_cast<int>(std::count(on_boundary.begin(), on_boundary.end(), 1)) - static_cast<int>(edges.size()) + report.boundary_quads;
  for (std::size_t c = 0; c < map.charts.size(); ++c) {
    const bool collapsed = std::binary_search(complex.collapsed.begin(), complex.collapsed.end(), static_cast<int>(c));
    if (map.charts[c].sign != 0 && !collapsed && !present[c]) report.lost_charts.push_back(static_cast<int>(c));
  }
  return report;
}

int euler_characteristic(const std::vector<Triangle>& triangles) {
  std::vector<std::array<int, 2>> edges;
  std::vector<int> nodes;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
      nodes.push_back(t[k]);
    }
  }
  const auto distinct = [](auto& v) {
    std::sort(v.begin(), v.end());
    return static_cast<int>(std::unique(v.begin(), v.end()) - v.begin());
  };
  return distinct(nodes) - distinct(edges) + static_cast<int>(triangles.size());
}

}  // namespace polycube
