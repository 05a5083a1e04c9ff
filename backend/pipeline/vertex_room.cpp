#include "pipeline/vertex_room.h"

#include <algorithm>

#include "label/regions.h"

namespace polycube {
namespace {

// Per tet mesh point: a CAD vertex that some CAD edge with a chain ends in.
std::vector<char> find_vertices(const CadModel& model, const TetMesh& tets, const std::vector<std::vector<int>>& edge_chains,
                                const std::vector<char>& ignored) {
  std::vector<char> wanted(static_cast<std::size_t>(model.vertex_count()) + 1, 0);
  for (const int e : model.edges()) {
    const CadEdge& edge = model.edge(e);
    if (edge.seam || edge.degenerate || edge.tiny || ignored[e] || edge_chains[e].size() < 2) continue;
    for (int v : edge.vertices) wanted[v] = 1;
  }
  std::vector<char> result(tets.points.size(), 0);
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = tets.point_cad[n].dim == 0 && wanted[tets.point_cad[n].id];
  return result;
}

}  // namespace

std::vector<DistanceConstraint> room_for_vertices(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                                  const std::vector<std::vector<int>>& edge_chains, const std::vector<char>& ignored) {
  const std::vector<char> vertex = find_vertices(model, tets, edge_chains, ignored);
  std::vector<int> chart_of(tets.triangles.size());
  std::vector<std::array<int, 3>> held(tets.points.size(), {-1, -1, -1});  // per point and axis: the unknown whose plane it lies on
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int t : map.charts[c].triangles) chart_of[t] = c;
    if (blocks.unknown[c] < 0) continue;
    for (int n : map.charts[c].nodes) held[n][map.charts[c].axis] = blocks.unknown[c];
  }
  std::vector<DistanceConstraint> constraints;
  for (const Arc& arc : build_region_graph(tets, chart_of).arcs) {
    const int a = map.charts[arc.left].axis, b = map.charts[arc.right].axis;
    if (a == b || arc.start < 0) continue;
    const int axis = 3 - a - b;
    int first = -1, inside = 0;
    for (int n : arc.nodes) {
      if (held[n][axis] < 0) {
        inside += vertex[n];
        continue;
      }
      if (first >= 0 && inside > 0) {
        const int cells = inside + 1 - !vertex[first] - !vertex[n];
        int low = held[first][axis], high = held[n][axis];
        if (map.charts[low].value > map.charts[high].value) std::swap(low, high);
        if (low != high && cells > 1) constraints.push_back({low, high, cells, std::numeric_limits<int>::max(), "room for CAD vertices", true});
      }
      first = n;
      inside = 0;
    }
  }
  return constraints;
}

}  // namespace polycube
