#include "pad/trial.h"

#include <algorithm>
#include <numbers>

#include "core/hexahedron.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

// A part of the mesh: all hexes that touch the nodes of a cut.
struct Part {
  PaddedMesh padded;
  SheetCut cut;
  std::vector<char> near;    // per node of the part: a node of the cut
  std::vector<int> node_of;  // per node of the part: node of the whole mesh
};

std::vector<int> sorted_unique(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<int> nodes_of_cut(const TrialMesh& whole, const SheetCut& cut) {
  std::vector<int> nodes;
  const auto& hexes = whole.padded.mesh.hexes;
  for (int h = 0; h < static_cast<int>(hexes.size()); ++h) {
    if (!cut.inside[h]) continue;
    for (int f = 0; f < 6; ++f) {
      const int mate = whole.topology.mate[6 * h + f];
      if (mate >= 0 ? cut.inside[mate / 6] : !cut.surface[-1 - mate]) continue;
      for (int c : kHexFaces[f]) nodes.push_back(hexes[h][c]);
    }
  }
  return sorted_unique(std::move(nodes));
}

Part cut_out(const TrialMesh& whole, const SheetCut& cut) {
  const HexMesh& mesh = whole.padded.mesh;
  const Association& a = whole.padded.association;
  const std::vector<int> near = nodes_of_cut(whole, cut);
  std::vector<int> hexes, quads, segments;
  for (int v : near) {
    hexes.insert(hexes.end(), whole.topology.node_hexes.begin() + whole.topology.node_first[v],
                 whole.topology.node_hexes.begin() + whole.topology.node_first[v + 1]);
  }
  hexes = sorted_unique(std::move(hexes));
  Part part;
  for (int h : hexes) part.node_of.insert(part.node_of.end(), mesh.hexes[h].begin(), mesh.hexes[h].end());
  part.node_of = sorted_unique(std::move(part.node_of));
  const auto local = [&](int v) {
    const auto it = std::lower_bound(part.node_of.begin(), part.node_of.end(), v);
    return it != part.node_of.end() && *it == v ? static_cast<int>(it - part.node_of.begin()) : -1;
  };
  Association& association = part.padded.association;
  association.patches = a.patches;
  for (int v : part.node_of) {
    part.padded.mesh.points.push_back(mesh.points[v]);
    association.point_cad.push_back(a.point_cad[v]);
    part.near.push_back(std::binary_search(near.begin(), near.end(), v));
    quads.insert(quads.end(), whole.node_quads[v].begin(), whole.node_quads[v].end());
    segments.insert(segments.end(), whole.node_segments[v].begin(), whole.node_segments[v].end());
  }
  for (int h : hexes) {
    Hex hex = mesh.hexes[h];
    for (int& v : hex) v = local(v);
    part.padded.mesh.hexes.push_back(hex);
    part.cut.inside.push_back(cut.inside[h]);
  }
  for (int q : sorted_unique(std::move(quads))) {
    if (!std::binary_search(hexes.begin(), hexes.end(), whole.topology.quad_side[q] / 6)) continue;
    Quad quad = a.quads[q];
    for (int& v : quad) v = local(v);
    association.quads.push_back(quad);
    association.quad_patch.push_back(a.quad_patch[q]);
    part.cut.surface.push_back(cut.surface[q]);
  }
  for (int s : sorted_unique(std::move(segments))) {
    const Segment segment{local(a.segments[s][0]), local(a.segments[s][1])};
    if (segment[0] < 0 || segment[1] < 0) continue;
    association.segments.push_back(segment);
    association.segment_edge.push_back(a.segment_edge[s]);
  }
  return part;
}

// Sum of angle costs at the edges that touch a near node and in the sectors at near nodes.
double total_cost(const CadModel& model, const HexMesh& mesh, const Association& association, const HexTopology& topology, const std::vector<char>& near) {
  const auto boundary = boundary_edges(mesh, association.quads, topology);
  const auto angles = dihedral_angles(model, mesh, association, boundary, near);
  double cost = 0;
  for (std::size_t e = 0; e < boundary.size(); ++e) {
    if (near[boundary[e].a] || near[boundary[e].b]) cost += angle_cost(boundary[e].hexes, angles[e]);
  }
  std::vector<std::array<int, 2>> edges;
  for (const Hex& hex : mesh.hexes) {
    for (const auto& [c, d] : kHexEdges) {
      if (near[hex[c]] || near[hex[d]]) edges.push_back({std::min(hex[c], hex[d]), std::max(hex[c], hex[d])});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    if (find_edge(boundary, edges[i][0], edges[i][1]) < 0) cost += kPadTuning.inner_weight * angle_cost(static_cast<int>(j - i), 2 * std::numbers::pi);
    i = j;
  }
  for (const Sector& s : find_sectors(model, mesh, association, near)) cost += angle_cost(s.quads, s.angle);
  return cost + inner_corner_cost(model, mesh, association, topology, near);
}

}  // namespace

TrialMesh::TrialMesh(const CadModel& cad, const PaddedMesh& mesh) : model(cad), padded(mesh), topology(build_topology(mesh.mesh, mesh.association.quads)) {
  node_quads.resize(mesh.mesh.points.size());
  node_segments.resize(mesh.mesh.points.size());
  for (int q = 0; q < static_cast<int>(mesh.association.quads.size()); ++q) {
    for (int node : mesh.association.quads[q]) node_quads[node].push_back(q);
  }
  for (int s = 0; s < static_cast<int>(mesh.association.segments.size()); ++s) {
    for (int node : mesh.association.segments[s]) node_segments[node].push_back(s);
  }
}

namespace {

// Nodes of fixed quads that the cut would double: such a quad may lie on the outer side of the layer, or away from the cut.
std::vector<int> fixed_obstacles(const TrialMesh& whole, const SheetCut& cut) {
  const Association& a = whole.padded.association;
  const std::vector<int>& fixed = whole.padded.fixed_faces;
  std::vector<int> obstacles;
  if (fixed.empty()) return obstacles;
  const std::vector<int> near = nodes_of_cut(whole, cut);
  for (std::size_t q = 0; q < a.quads.size(); ++q) {
    const std::vector<int>& faces = a.patches[a.quad_patch[q]];
    const bool is_fixed = std::any_of(faces.begin(), faces.end(), [&](int f) { return std::binary_search(fixed.begin(), fixed.end(), f); });
    if (!is_fixed || cut.surface[q] || !cut.inside[whole.topology.quad_side[q] / 6]) continue;
    for (int v : a.quads[q]) {
      if (std::binary_search(near.begin(), near.end(), v)) obstacles.push_back(v);
    }
  }
  return sorted_unique(std::move(obstacles));
}

}  // namespace

TrialResult try_sheet(const TrialMesh& whole, const SheetCut& cut) {
  TrialResult result;
  result.obstacles = fixed_obstacles(whole, cut);
  if (!result.obstacles.empty()) return result;
  Part part = cut_out(whole, cut);
  const HexTopology topology = build_topology(part.padded.mesh, part.padded.association.quads);
  OpenedMesh opened = open_sheet(part.padded.mesh, part.padded.association, part.cut, topology);
  result.obstacles = std::move(opened.obstacles);
  for (int& v : result.obstacles) v = part.node_of[v];
  if (!result.obstacles.empty()) return result;
  result.gain = total_cost(whole.model, part.padded.mesh, part.padded.association, topology, part.near);
  result.added = opened.added;
  part.near.resize(opened.mesh.points.size(), 1);
  const HexTopology after = build_topology(opened.mesh, opened.association.quads);
  result.gain -= total_cost(whole.model, opened.mesh, opened.association, after, part.near) + kPadTuning.hex_price * result.added;
  return result;
}

}  // namespace polycube
