#include "label/regions.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "core/charts.h"

namespace polycube {
namespace {

struct Side {
  int triangle, corner;  // the directed edge corner -> corner + 1 of the triangle
};

double dihedral(const TetMesh& mesh, int t, int n) {
  const auto normal = [&](int i) {
    const Triangle& tri = mesh.triangles[i];
    return Vec3((mesh.points[tri[1]] - mesh.points[tri[0]]).cross(mesh.points[tri[2]] - mesh.points[tri[0]]).normalized());
  };
  const auto centre = [&](int i) {
    const Triangle& tri = mesh.triangles[i];
    return Vec3((mesh.points[tri[0]] + mesh.points[tri[1]] + mesh.points[tri[2]]) / 3);
  };
  const Vec3 a = normal(t), b = normal(n);
  const double bend = std::acos(std::clamp(a.dot(b), -1.0, 1.0));
  const bool convex = (centre(n) - centre(t)).dot(a) <= 0;
  return std::numbers::pi + (convex ? -bend : bend);
}

}  // namespace

RegionGraph build_region_graph(const TetMesh& mesh, const std::vector<int>& triangle_region) {
  RegionGraph g;
  g.triangle_region = triangle_region;
  const int n_regions = triangle_region.empty() ? 0 : *std::max_element(triangle_region.begin(), triangle_region.end()) + 1;
  g.regions.resize(n_regions);
  const auto neighbours = triangle_neighbours(mesh.triangles);
  // Directed border edges by their start point; each has its region on the left.
  std::unordered_map<int, std::vector<Side>> leaving;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const Triangle& tri = mesh.triangles[t];
    Region& r = g.regions[triangle_region[t]];
    r.face = mesh.triangle_face[t];
    r.triangles.push_back(t);
    r.area += 0.5 * (mesh.points[tri[1]] - mesh.points[tri[0]]).cross(mesh.points[tri[2]] - mesh.points[tri[0]]).norm();
    for (int k = 0; k < 3; ++k) {
      if (neighbours[t][k] >= 0 && triangle_region[neighbours[t][k]] != triangle_region[t]) leaving[tri[k]].push_back({t, k});
    }
  }
  const auto to = [&](const Side& s) { return mesh.triangles[s.triangle][(s.corner + 1) % 3]; };
  const auto left = [&](const Side& s) { return triangle_region[s.triangle]; };
  const auto right = [&](const Side& s) { return triangle_region[neighbours[s.triangle][s.corner]]; };

  std::vector<int> nodes;
  nodes.reserve(leaving.size());
  for (const auto& [node, sides] : leaving) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  std::unordered_map<int, int> junction_of;
  for (int node : nodes) {
    if (leaving[node].size() == 2) continue;
    junction_of[node] = static_cast<int>(g.junctions.size());
    g.junctions.push_back({node, {}});
  }
  // Each undirected border edge is walked once, from junctions first, then what is left as closed chains.
  std::map<std::pair<int, int>, int> dart_of;  // (start node, next node) -> dart leaving there
  const auto trace = [&](int from, Side side) {
    const int next = to(side);
    if (dart_of.count({from, next})) return;
    Arc arc;
    arc.left = left(side);
    arc.right = right(side);
    arc.nodes = {from};
    const int id = static_cast<int>(g.arcs.size());
    double bend = 0;
    dart_of[{from, next}] = 2 * id;
    int previous = from, at = from;
    for (;;) {
      previous = at;
      at = to(side);
      const double length = (mesh.points[at] - mesh.points[previous]).norm();
      arc.length += length;
      bend += length * dihedral(mesh, side.triangle, neighbours[side.triangle][side.corner]);
      arc.nodes.push_back(at);
      if (junction_of.count(at) || at == from) break;
      for (const Side& s : leaving[at]) {
        if (left(s) == arc.left && right(s) == arc.right && to(s) != previous) {
          side = s;
          break;
        }
      }
      dart_of[{at, to(side)}] = 2 * id;
    }
    dart_of[{at, previous}] = 2 * id + 1;
    // Inner points in the other direction too, so that a closed chain is not walked twice.
    for (std::size_t i = 1; i + 1 < arc.nodes.size(); ++i) dart_of[{arc.nodes[i], arc.nodes[i - 1]}] = 2 * id + 1;
    for (int node : arc.nodes) arc.cad_dim.push_back(node < std::ssize(mesh.point_cad) ? static_cast<char>(mesh.point_cad[node].dim) : 2);
    arc.angle = arc.length > 0 ? bend / arc.length : std::numbers::pi;
    if (junction_of.count(arc.nodes.front())) {
      arc.start = junction_of[arc.nodes.front()];
      arc.end = junction_of[arc.nodes.back()];
    }
    g.arcs.push_back(std::move(arc));
  };
  for (const Junction& j : g.junctions) {
    for (const Side& s : leaving[j.node]) trace(j.node, s);
  }
  for (int node : nodes) {
    for (const Side& s : leaving[node]) trace(node, s);
  }
  // Order the darts round each junction by turning through its triangles.
  std::unordered_map<int, int> any_triangle;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int v : mesh.triangles[t]) {
      if (junction_of.count(v)) any_triangle.try_emplace(v, t);
    }
  }
  for (Junction& j : g.junctions) {
    const int first = any_triangle[j.node];
    int t = first;
    do {
      const Triangle& tri = mesh.triangles[t];
      const int k = static_cast<int>(std::find(tri.begin(), tri.end(), j.node) - tri.begin());
      if (auto it = dart_of.find({j.node, tri[(k + 1) % 3]}); it != dart_of.end()) j.darts.push_back(it->second);
      t = neighbours[t][(k + 2) % 3];  // across the edge that arrives at the node: the next triangle counter-clockwise
    } while (t != first && t >= 0);
  }
  return g;
}

}  // namespace polycube
