#include "pad/sheet.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/hexahedron.h"
#include "pad/topology.h"

namespace polycube {

namespace {

// The copy of a node that one fan of inside hexes takes.
struct Copy {
  int node = 0;
  int fans = 0;               // fans of cut faces at it; more than one cannot be opened
  bool on_boundary = false;   // it has boundary quads
  std::vector<int> patches;   // of these quads
  std::vector<int> segments;  // moved segments that end at it
  CadRef cad;
  bool obstacle = false;
};

class Opening {
 public:
  Opening(const HexMesh& mesh, const Association& association, const SheetCut& cut, const HexTopology& topology)
      : mesh_(mesh), association_(association), cut_(cut), topology_(topology) {
    find_faces();
    find_copies();
    follow_edges();
    find_moved();
    classify();
  }

  std::vector<int> obstacles() const {
    std::vector<int> nodes;
    for (const Copy& copy : copies_) {
      if (copy.obstacle) nodes.push_back(copy.node);
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  void apply(OpenedMesh& opened) const;
  int face_count() const { return static_cast<int>(faces_.size()); }

 private:
  // What an edge of a cut face leads to, round the edge through inside hexes.
  struct End {
    bool border = false;  // the mesh boundary
    int at = -1;          // the boundary quad there, or the index of the cut face
  };

  bool is_cut(int side) const {
    const int mate = topology_.mate[side];
    if (mate >= 0) return !cut_.inside[mate / 6];
    const std::size_t quad = static_cast<std::size_t>(-1 - mate);
    return quad < cut_.surface.size() && cut_.surface[quad];  // a part cut out of a mesh ends at faces that are not listed
  }
  int face_node(int side, int k) const { return mesh_.hexes[side / 6][kHexFaces[side % 6][k]]; }
  int copy_at(int hex, int node) const { return corner_copy_[8 * hex + corner_of(mesh_.hexes[hex], node)]; }
  int side_copy(int side, int k) const { return corner_copy_[8 * (side / 6) + kHexFaces[side % 6][k]]; }
  bool quad_moves(int quad) const { return !cut_.surface[quad] && cut_.inside[topology_.quad_side[quad] / 6]; }

  void find_faces();
  void find_copies();
  void follow_edges();
  void find_moved();
  void classify();
  Vec3 place(const Copy& copy, const std::vector<Vec3>& sums, const std::vector<int>& counts, int index) const;

  const HexMesh& mesh_;
  const Association& association_;
  const SheetCut& cut_;
  const HexTopology& topology_;
  std::vector<int> faces_;        // cut faces as sides of inside hexes
  std::vector<int> face_index_;   // per side, -1 if not cut
  std::vector<int> corner_copy_;  // per 8 * hex + corner: index into copies_, -1
  std::vector<Copy> copies_;
  std::vector<End> ends_;  // per 4 * cut face + edge
  std::vector<char> moved_segment_;
  std::vector<int> segment_hex_;         // per moved segment: an inside hex on it
  std::vector<char> outer_on_boundary_;  // per node: the outer copy keeps boundary quads
};

void Opening::find_faces() {
  face_index_.assign(6 * mesh_.hexes.size(), -1);
  for (int h = 0; h < static_cast<int>(mesh_.hexes.size()); ++h) {
    if (!cut_.inside[h]) continue;
    for (int f = 0; f < 6; ++f) {
      if (!is_cut(6 * h + f)) continue;
      face_index_[6 * h + f] = static_cast<int>(faces_.size());
      faces_.push_back(6 * h + f);
    }
  }
}

void Opening::find_copies() {
  std::vector<char> touched(mesh_.points.size(), 0);
  for (int side : faces_) {
    for (int k = 0; k < 4; ++k) touched[face_node(side, k)] = 1;
  }
  corner_copy_.assign(8 * mesh_.hexes.size(), -1);
  std::vector<int> stack;
  for (int v = 0; v < static_cast<int>(mesh_.points.size()); ++v) {
    if (!touched[v]) continue;
    for (int i = topology_.node_first[v]; i < topology_.node_first[v + 1]; ++i) {
      const int seed = topology_.node_hexes[i];
      if (!cut_.inside[seed] || copy_at(seed, v) >= 0) continue;
      const int index = static_cast<int>(copies_.size());
      copies_.push_back({});
      copies_.back().node = v;
      stack.assign(1, seed);
      corner_copy_[8 * seed + corner_of(mesh_.hexes[seed], v)] = index;
      while (!stack.empty()) {
        const int h = stack.back();
        stack.pop_back();
        const int c = corner_of(mesh_.hexes[h], v);
        for (int f = 0; f < 6; ++f) {
          const auto& corners = kHexFaces[f];
          const int mate = topology_.mate[6 * h + f];
          if (std::find(corners.begin(), corners.end(), c) == corners.end() || mate < 0 || !cut_.inside[mate / 6]) continue;
          int& other = corner_copy_[8 * (mate / 6) + corner_of(mesh_.hexes[mate / 6], v)];
          if (other >= 0) continue;
          other = index;
          stack.push_back(mate / 6);
        }
      }
    }
  }
}

void Opening::follow_edges() {
  ends_.resize(4 * faces_.size());
  for (int i = 0; i < face_count(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const int a = face_node(faces_[i], k), b = face_node(faces_[i], (k + 1) % 4);
      int side = faces_[i];
      End& end = ends_[4 * i + k];
      while (true) {
        const int hex = side / 6;
        const int next = 6 * hex + other_face(mesh_.hexes[hex], side % 6, a, b);
        if (face_index_[next] >= 0) {
          end.at = face_index_[next];
          break;
        }
        side = topology_.mate[next];
        if (side < 0) {
          end = {true, -1 - side};
          break;
        }
      }
    }
  }
  // Fans of cut faces round each copy: corners of cut faces united across the edges where two cut faces meet.
  std::vector<int> root(4 * faces_.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int x) {
    while (root[x] != x) x = root[x] = root[root[x]];
    return x;
  };
  const auto corner_in = [&](int face, int node) {
    int k = 0;
    while (face_node(faces_[face], k) != node) ++k;
    return 4 * face + k;
  };
  for (int i = 0; i < face_count(); ++i) {
    for (int k = 0; k < 4; ++k) {
      const End& end = ends_[4 * i + k];
      if (end.border) continue;
      for (int corner : {k, (k + 1) % 4}) {
        const int x = find(4 * i + corner), y = find(corner_in(end.at, face_node(faces_[i], corner)));
        root[std::max(x, y)] = std::min(x, y);
      }
    }
  }
  for (int i = 0; i < 4 * face_count(); ++i) {
    if (find(i) == i) ++copies_[side_copy(faces_[i / 4], i % 4)].fans;
  }
}

void Opening::find_moved() {
  outer_on_boundary_.assign(mesh_.points.size(), 0);
  for (int q = 0; q < static_cast<int>(association_.quads.size()); ++q) {
    if (!quad_moves(q)) {
      for (int node : association_.quads[q]) outer_on_boundary_[node] = 1;
      continue;
    }
    const int hex = topology_.quad_side[q] / 6;
    for (int node : association_.quads[q]) {
      const int copy = copy_at(hex, node);
      if (copy < 0) {
        outer_on_boundary_[node] = 1;
        continue;
      }
      copies_[copy].on_boundary = true;
      copies_[copy].patches.push_back(association_.quad_patch[q]);
    }
  }
  for (int i = 0; i < face_count(); ++i) {
    for (int k = 0; k < 4; ++k) {
      if (!ends_[4 * i + k].border) continue;
      for (int corner : {k, (k + 1) % 4}) {
        outer_on_boundary_[face_node(faces_[i], corner)] = 1;
        Copy& copy = copies_[side_copy(faces_[i], corner)];
        copy.on_boundary = true;
        copy.patches.push_back(association_.quad_patch[ends_[4 * i + k].at]);
      }
    }
  }
  // A segment moves with the inside hexes if they fill the whole wedge between its two quads and no layer comes between.
  const auto edges = boundary_edges(mesh_, association_.quads, topology_);
  moved_segment_.assign(association_.segments.size(), 0);
  segment_hex_.assign(association_.segments.size(), -1);
  for (int s = 0; s < static_cast<int>(association_.segments.size()); ++s) {
    const auto [a, b] = association_.segments[s];
    const int found = find_edge(edges, a, b);
    if (found < 0) continue;
    const auto& quads = edges[found].quads;
    if (!quad_moves(quads[0]) || !quad_moves(quads[1])) continue;
    bool whole = true;
    for (int side = topology_.quad_side[quads[0]]; side >= 0;) {
      const int hex = side / 6;
      whole = whole && cut_.inside[hex];
      side = topology_.mate[6 * hex + other_face(mesh_.hexes[hex], side % 6, a, b)];
    }
    if (!whole) continue;
    moved_segment_[s] = 1;
    segment_hex_[s] = topology_.quad_side[quads[0]] / 6;
    for (int node : association_.segments[s]) {
      const int copy = copy_at(segment_hex_[s], node);
      if (copy >= 0) copies_[copy].segments.push_back(s);
    }
  }
}

void Opening::classify() {
  std::vector<int> heirs(mesh_.points.size(), 0);  // copies that would take over the CAD entity of their node
  for (Copy& copy : copies_) {
    std::sort(copy.patches.begin(), copy.patches.end());
    copy.patches.erase(std::unique(copy.patches.begin(), copy.patches.end()), copy.patches.end());
    copy.obstacle = copy.fans != 1;
    if (!copy.on_boundary) {
      copy.cad = {3, 1};
    } else if (!outer_on_boundary_[copy.node]) {
      copy.cad = association_.point_cad[copy.node];
      if (++heirs[copy.node] > 1) copy.obstacle = true;
    } else if (copy.segments.empty()) {
      copy.cad = {2, copy.patches[0]};
      if (copy.patches.size() > 1) copy.obstacle = true;
    } else {
      copy.cad = {1, association_.segment_edge[copy.segments[0]]};
      if (copy.segments.size() > 1) copy.obstacle = true;
    }
  }
}

Vec3 Opening::place(const Copy& copy, const std::vector<Vec3>& sums, const std::vector<int>& counts, int index) const {
  const Vec3& x = mesh_.points[copy.node];
  if (copy.on_boundary && outer_on_boundary_[copy.node] && !copy.segments.empty()) {
    const Segment& s = association_.segments[copy.segments[0]];
    return x + (mesh_.points[s[0] == copy.node ? s[1] : s[0]] - x) / 3;
  }
  if (copy.on_boundary && !outer_on_boundary_[copy.node]) return x;
  return counts[index] > 0 ? Vec3(x + 2.0 / 3.0 * (sums[index] / counts[index] - x)) : x;
}

void Opening::apply(OpenedMesh& opened) const {
  const int old_nodes = static_cast<int>(mesh_.points.size()), old_hexes = static_cast<int>(mesh_.hexes.size());
  const auto node_of = [&](int hex, int node) {
    const int copy = copy_at(hex, node);
    return copy < 0 ? node : old_nodes + copy;
  };
  // First places: towards the centres of the hexes, or boundary quads, that take the copy.
  std::vector<Vec3> sums(copies_.size(), Vec3::Zero());
  std::vector<int> counts(copies_.size(), 0);
  for (int h = 0; h < old_hexes; ++h) {
    Vec3 centre = Vec3::Zero();
    for (int node : mesh_.hexes[h]) centre += mesh_.points[node] / 8;
    for (int c = 0; c < 8; ++c) {
      const int copy = corner_copy_[8 * h + c];
      if (copy < 0 || copies_[copy].on_boundary) continue;
      sums[copy] += centre;
      ++counts[copy];
    }
  }
  HexMesh& result = opened.mesh;
  Association& carried = opened.association;
  result.points = mesh_.points;
  result.hexes = mesh_.hexes;
  carried = association_;
  for (int q = 0; q < static_cast<int>(association_.quads.size()); ++q) {
    if (!quad_moves(q)) continue;
    const int hex = topology_.quad_side[q] / 6;
    Vec3 centre = Vec3::Zero();
    for (int node : association_.quads[q]) centre += mesh_.points[node] / 4;
    for (int& node : carried.quads[q]) {
      const int copy = copy_at(hex, node);
      if (copy < 0) continue;
      sums[copy] += centre;
      ++counts[copy];
      node = old_nodes + copy;
    }
  }
  for (int i = 0; i < static_cast<int>(copies_.size()); ++i) {
    const Copy& copy = copies_[i];
    result.points.push_back(place(copy, sums, counts, i));
    carried.point_cad.push_back(copy.cad);
    if (!copy.on_boundary) continue;
    if (!outer_on_boundary_[copy.node]) {
      carried.point_cad[copy.node] = {3, 1};
    } else if (!copy.segments.empty()) {
      carried.segments.push_back({copy.node, old_nodes + i});
      carried.segment_edge.push_back(copy.cad.id);
    }
  }
  for (int s = 0; s < static_cast<int>(association_.segments.size()); ++s) {
    if (!moved_segment_[s]) continue;
    for (int& node : carried.segments[s]) node = node_of(segment_hex_[s], node);
  }
  for (int h = 0; h < old_hexes; ++h) {
    for (int c = 0; c < 8; ++c) {
      if (corner_copy_[8 * h + c] >= 0) result.hexes[h][c] = old_nodes + corner_copy_[8 * h + c];
    }
  }
  for (int i = 0; i < face_count(); ++i) {
    Hex hex;
    for (int k = 0; k < 4; ++k) {
      hex[k] = old_nodes + side_copy(faces_[i], k);
      hex[k + 4] = face_node(faces_[i], k);
    }
    result.hexes.push_back(hex);
    for (int k = 0; k < 4; ++k) {
      if (!ends_[4 * i + k].border) continue;
      const int next = (k + 1) % 4;
      carried.quads.push_back({hex[k], hex[next], hex[next + 4], hex[k + 4]});
      carried.quad_patch.push_back(association_.quad_patch[ends_[4 * i + k].at]);
      opened.beside.push_back(ends_[4 * i + k].at);
    }
  }
  opened.added = face_count();
}

}  // namespace

OpenedMesh open_sheet(const HexMesh& mesh, const Association& association, const SheetCut& cut, const HexTopology& topology) {
  const Opening opening(mesh, association, cut, topology);
  OpenedMesh opened;
  opened.obstacles = opening.obstacles();
  if (opened.obstacles.empty()) opening.apply(opened);
  return opened;
}

int insert_sheet(HexMesh& mesh, Association& association, const SheetCut& cut, const HexTopology& topology) {
  OpenedMesh opened = open_sheet(mesh, association, cut, topology);
  if (!opened.obstacles.empty()) throw StageFailed("pad", "a sheet would branch at node " + std::to_string(opened.obstacles[0]));
  mesh = std::move(opened.mesh);
  association = std::move(opened.association);
  return opened.added;
}

int insert_sheet(HexMesh& mesh, Association& association, const SheetCut& cut) {
  return insert_sheet(mesh, association, cut, build_topology(mesh, association.quads));
}

}  // namespace polycube
