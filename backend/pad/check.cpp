#include <algorithm>

#include "core/hexahedron.h"
#include "pad/pad.h"
#include "pad/topology.h"

namespace polycube {

namespace {

using Faults = std::vector<std::string>;

std::string at(const char* what, int index) { return std::string(what) + " " + std::to_string(index); }

bool same_cycle(const Quad& a, const Quad& b) {
  for (int shift = 0; shift < 4; ++shift) {
    int equal = 0;
    for (int k = 0; k < 4; ++k) equal += a[k] == b[(k + shift) % 4];
    if (equal == 4) return true;
  }
  return false;
}

// Sizes and ranges; nothing else can be looked at if these fail.
void check_ranges(const HexMesh& mesh, const Association& a, Faults& faults) {
  const int nodes = static_cast<int>(mesh.points.size()), patches = static_cast<int>(a.patches.size());
  if (a.point_cad.size() != mesh.points.size()) faults.push_back("point_cad has not one entry a node");
  if (a.quad_patch.size() != a.quads.size()) faults.push_back("quad_patch has not one entry a quad");
  if (a.segment_edge.size() != a.segments.size()) faults.push_back("segment_edge has not one entry a segment");
  const auto outside = [&](int node) { return node < 0 || node >= nodes; };
  for (const Hex& hex : mesh.hexes) {
    Hex sorted = hex;
    std::sort(sorted.begin(), sorted.end());
    if (outside(sorted[0]) || outside(sorted[7]) || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      faults.push_back(at("hex with a bad or repeated node:", static_cast<int>(&hex - mesh.hexes.data())));
    }
  }
  for (const Quad& quad : a.quads) {
    if (std::any_of(quad.begin(), quad.end(), outside)) faults.push_back("quad with a node out of range");
  }
  for (const Segment& s : a.segments) {
    if (outside(s[0]) || outside(s[1])) faults.push_back("segment with a node out of range");
  }
  for (int p : a.quad_patch) {
    if (p < 0 || p >= patches) faults.push_back("quad with a patch out of range");
  }
}

void check_boundary(const HexMesh& mesh, const Association& a, const HexTopology& topology, Faults& faults) {
  const int unlisted = -1 - static_cast<int>(a.quads.size());
  for (int side : topology.overfull) faults.push_back(at("face shared by more than two hexes at hex", side / 6));
  if (!topology.overfull.empty()) return;
  for (std::size_t side = 0; side < topology.mate.size(); ++side) {
    if (topology.mate[side] == unlisted) faults.push_back(at("boundary face without a quad at hex", static_cast<int>(side) / 6));
  }
  for (int q = 0; q < static_cast<int>(a.quads.size()); ++q) {
    const int side = topology.quad_side[q];
    if (side < 0) {
      faults.push_back(at("no boundary face:", q));
      continue;
    }
    Quad outward;
    for (int k = 0; k < 4; ++k) outward[k] = mesh.hexes[side / 6][kHexFaces[side % 6][k]];
    if (!same_cycle(outward, a.quads[q])) faults.push_back(at("quad not outward:", q));
  }
}

// The link of a node must be a sphere (inside) or a disk (boundary): connected and of the right Euler characteristic.
void check_links(const HexMesh& mesh, const HexTopology& topology, const std::vector<char>& on_boundary, Faults& faults) {
  std::vector<int> neighbours, pending;
  std::vector<int> seen(mesh.hexes.size(), -1);
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
    const int first = topology.node_first[v], last = topology.node_first[v + 1];
    if (first == last) {
      faults.push_back(at("unused node", v));
      continue;
    }
    neighbours.clear();
    int doubled_faces = 0, reached = 1;
    pending.assign(1, topology.node_hexes[first]);
    seen[pending[0]] = v;
    while (!pending.empty()) {
      const int h = pending.back();
      pending.pop_back();
      const int c = corner_of(mesh.hexes[h], v);
      for (int n : kCornerNeighbours[c]) neighbours.push_back(mesh.hexes[h][n]);
      for (int f = 0; f < 6; ++f) {
        if (std::find(kHexFaces[f].begin(), kHexFaces[f].end(), c) == kHexFaces[f].end()) continue;
        const int mate = topology.mate[6 * h + f];
        doubled_faces += mate >= 0 ? 1 : 2;
        if (mate < 0 || seen[mate / 6] == v) continue;
        seen[mate / 6] = v;
        ++reached;
        pending.push_back(mate / 6);
      }
    }
    std::sort(neighbours.begin(), neighbours.end());
    const int edges = static_cast<int>(std::unique(neighbours.begin(), neighbours.end()) - neighbours.begin());
    const int characteristic = edges - doubled_faces / 2 + reached;
    if (reached != last - first || characteristic != (on_boundary[v] ? 1 : 2)) faults.push_back(at("non-manifold node", v));
  }
}

void check_classes(const Association& a, const std::vector<BoundaryEdge>& edges, const std::vector<char>& on_boundary, Faults& faults) {
  const int nodes = static_cast<int>(a.point_cad.size());
  std::vector<std::array<int, 3>> segments;
  for (std::size_t s = 0; s < a.segments.size(); ++s) {
    segments.push_back({std::min(a.segments[s][0], a.segments[s][1]), std::max(a.segments[s][0], a.segments[s][1]), a.segment_edge[s]});
  }
  std::sort(segments.begin(), segments.end());
  for (std::size_t s = 1; s < segments.size(); ++s) {
    if (segments[s][0] == segments[s - 1][0] && segments[s][1] == segments[s - 1][1]) faults.push_back(at("two segments on one edge at node", segments[s][0]));
  }
  std::vector<std::vector<int>> node_edges(nodes);
  for (const auto& s : segments) {
    node_edges[s[0]].push_back(s[2]);
    node_edges[s[1]].push_back(s[2]);
  }
  const auto key_less = [](const auto& s, const std::array<int, 2>& key) { return std::array{s[0], s[1]} < key; };
  std::size_t found = 0;
  for (const BoundaryEdge& e : edges) {
    const auto it = std::lower_bound(segments.begin(), segments.end(), std::array{e.a, e.b}, key_less);
    const bool listed = it != segments.end() && (*it)[0] == e.a && (*it)[1] == e.b;
    found += listed;
    if (!listed && a.quad_patch[e.quads[0]] != a.quad_patch[e.quads[1]]) faults.push_back(at("two patches meet without a segment at node", e.a));
  }
  if (found != segments.size()) faults.push_back("segment that is no boundary edge");
  std::vector<std::vector<int>> node_patches(nodes);
  for (std::size_t q = 0; q < a.quads.size(); ++q) {
    for (int node : a.quads[q]) node_patches[node].push_back(a.quad_patch[q]);
  }
  std::vector<int> vertices;
  for (int v = 0; v < nodes; ++v) {
    const CadRef& cad = a.point_cad[v];
    if ((cad.dim == 3) == static_cast<bool>(on_boundary[v])) faults.push_back(at("boundary and class contradict at node", v));
    if (cad.dim == 0) vertices.push_back(cad.id);
    if (cad.dim == 1 && node_edges[v] != std::vector<int>{cad.id, cad.id}) faults.push_back(at("chain of a CAD edge broken at node", v));
    if (cad.dim == 2) {
      const auto& p = node_patches[v];
      if (std::any_of(p.begin(), p.end(), [&](int patch) { return patch != cad.id; })) faults.push_back(at("quads of another patch at node", v));
      if (!node_edges[v].empty()) faults.push_back(at("segment at a node inside a patch:", v));
    }
  }
  std::sort(vertices.begin(), vertices.end());
  if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end()) faults.push_back("two nodes on one CAD vertex");
}

}  // namespace

std::vector<std::string> check(const HexMesh& mesh, const Association& association) {
  Faults faults;
  check_ranges(mesh, association, faults);
  if (!faults.empty()) return faults;
  const HexTopology topology = build_topology(mesh, association.quads);
  check_boundary(mesh, association, topology, faults);
  if (!faults.empty()) return faults;
  std::vector<char> on_boundary(mesh.points.size(), 0);
  for (const Quad& quad : association.quads) {
    for (int node : quad) on_boundary[node] = 1;
  }
  check_links(mesh, topology, on_boundary, faults);
  if (!faults.empty()) return faults;
  check_classes(association, boundary_edges(mesh, association.quads, topology), on_boundary, faults);
  return faults;
}

}  // namespace polycube
