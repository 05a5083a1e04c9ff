#include "blocks/topology.h"

#include <algorithm>

#include "core/error.h"

namespace polycube {
namespace {

struct Facet {
  std::array<int, 3> nodes;
  int place;  ///< 4 * tet + facet; a boundary triangle t is -1 - t
};

std::array<int, 3> sorted(std::array<int, 3> v) {
  std::sort(v.begin(), v.end());
  return v;
}

}  // namespace

TetTopology find_topology(const TetMesh& mesh) {
  const int tet_count = static_cast<int>(mesh.tets.size()), point_count = static_cast<int>(mesh.points.size());
  TetTopology result;
  result.neighbours.assign(tet_count, {-1, -1, -1, -1});
  result.triangles.assign(tet_count, {-1, -1, -1, -1});
  result.node_tets_first.assign(point_count + 1, 0);
  for (const Tet& tet : mesh.tets) {
    for (int v : tet) {
      if (v < 0 || v >= point_count) throw InvalidInput("a tetrahedron refers to a point that does not exist");
      ++result.node_tets_first[v + 1];
    }
  }
  for (int i = 0; i < point_count; ++i) result.node_tets_first[i + 1] += result.node_tets_first[i];
  result.node_tets.resize(4 * mesh.tets.size());
  auto fill = result.node_tets_first;
  for (int t = 0; t < tet_count; ++t) {
    for (int v : mesh.tets[t]) result.node_tets[fill[v]++] = t;
  }
  // Facets by their smallest node: the groups are short, so sorting each is nearly linear.
  std::vector<int> first(point_count + 1, 0);
  std::vector<Facet> facets;
  facets.reserve(4 * mesh.tets.size() + mesh.triangles.size());
  for (int t = 0; t < tet_count; ++t) {
    for (int f = 0; f < 4; ++f) {
      const auto& k = kTetFacets[f];
      facets.push_back({sorted({mesh.tets[t][k[0]], mesh.tets[t][k[1]], mesh.tets[t][k[2]]}), 4 * t + f});
    }
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int v : mesh.triangles[t]) {
      if (v < 0 || v >= point_count) throw InvalidInput("a boundary triangle refers to a point that does not exist");
    }
    facets.push_back({sorted(mesh.triangles[t]), -1 - t});
  }
  for (const Facet& facet : facets) ++first[facet.nodes[0] + 1];
  for (int i = 0; i < point_count; ++i) first[i + 1] += first[i];
  std::vector<Facet> grouped(facets.size());
  auto at = first;
  for (const Facet& facet : facets) grouped[at[facet.nodes[0]]++] = facet;
  for (int i = 0; i < point_count; ++i) {
    const auto begin = grouped.begin() + first[i], end = grouped.begin() + first[i + 1];
    std::sort(begin, end, [](const Facet& a, const Facet& b) { return a.nodes != b.nodes ? a.nodes < b.nodes : a.place < b.place; });
    for (auto run = begin; run != end;) {
      auto stop = run;
      while (stop != end && stop->nodes == run->nodes) ++stop;
      if (stop - run != 2) throw InvalidInput("the boundary triangles are not the facets of the tetrahedra that have one side only");
      const int a = run[0].place, b = run[1].place;  // a triangle sorts first
      if (b < 0) throw InvalidInput("a boundary triangle is listed twice or belongs to no tetrahedron");
      if (a < 0) {
        result.triangles[b / 4][b % 4] = -1 - a;
      } else {
        result.neighbours[a / 4][a % 4] = b / 4;
        result.neighbours[b / 4][b % 4] = a / 4;
      }
      run = stop;
    }
  }
  return result;
}

}  // namespace polycube
