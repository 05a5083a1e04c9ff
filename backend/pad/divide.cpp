#include "pad/divide.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/hexahedron.h"
#include "core/union_find.h"

namespace polycube {

namespace {

// The axis of a hex along which an edge of it runs, -1 if it has no such edge.
int axis_of(const Hex& hex, int a, int b) {
  const int c = corner_of(hex, a), d = corner_of(hex, b);
  return c < 0 || d < 0 ? -1 : edge_axis(c, d);
}

// Of a side with the face's four nodes, an edge of it that runs along an axis of the hex.
std::array<int, 2> edge_along(const Hex& hex, int face, int axis) {
  for (int k = 0; k < 4; ++k) {
    const int c = kHexFaces[face][k], d = kHexFaces[face][(k + 1) % 4];
    if (kCornerCoordinates[c][axis] != kCornerCoordinates[d][axis]) return {hex[c], hex[d]};
  }
  return {-1, -1};
}

// The corners of a hex at its lower end along an axis, each with its partner at the upper end.
std::array<std::array<int, 2>, 4> pairs_along(int axis) {
  std::array<std::array<int, 2>, 4> pairs{};
  int count = 0;
  for (const auto& [c, d] : kHexEdges) {
    if (kCornerCoordinates[c][axis] == kCornerCoordinates[d][axis]) continue;
    pairs[count++] = kCornerCoordinates[c][axis] == 0 ? std::array{c, d} : std::array{d, c};
  }
  return pairs;
}

// The nodes along every edge across the sheet, by its ends, the lesser first.
class Rungs {
 public:
  Rungs(PaddedMesh& padded, int parts) : padded_(padded), parts_(parts) {}

  void add(int a, int b) {
    if (a > b) std::swap(a, b);
    std::vector<int>& nodes = rungs_[{a, b}];
    if (!nodes.empty()) return;
    nodes.push_back(a);
    for (int k = 1; k < parts_; ++k) {
      const double t = static_cast<double>(k) / parts_;
      nodes.push_back(static_cast<int>(padded_.mesh.points.size()));
      padded_.mesh.points.push_back((1 - t) * padded_.mesh.points[a] + t * padded_.mesh.points[b]);
      padded_.association.point_cad.push_back({3, 1});
    }
    nodes.push_back(b);
  }
  // Null if the edge is none across the sheet.
  const std::vector<int>* find(int a, int b) const {
    const auto it = rungs_.find({std::min(a, b), std::max(a, b)});
    return it == rungs_.end() ? nullptr : &it->second;
  }
  // The k-th node from a towards b.
  int node(int a, int b, int k) const {
    const std::vector<int>& nodes = *find(a, b);
    return a < b ? nodes[k] : nodes[parts_ - k];
  }
  void classify(int a, int b, const CadRef& cad) {
    for (int k = 1; k < parts_; ++k) padded_.association.point_cad[node(a, b, k)] = cad;
  }

 private:
  PaddedMesh& padded_;
  int parts_;
  std::map<std::array<int, 2>, std::vector<int>> rungs_;
};

}  // namespace

TracedSheet trace_sheet(const HexMesh& mesh, const HexTopology& topology, int side) {
  TracedSheet sheet;
  std::vector<signed char> axis(mesh.hexes.size(), -1);
  const auto reach = [&](int hex, int along) {
    if (axis[hex] >= 0) {
      sheet.simple = sheet.simple && axis[hex] == along;
      return;
    }
    axis[hex] = static_cast<signed char>(along);
    sheet.hexes.push_back(hex);
    sheet.axes.push_back(along);
  };
  reach(side / 6, side % 6 / 2);
  for (std::size_t i = 0; i < sheet.hexes.size() && sheet.simple; ++i) {
    const int hex = sheet.hexes[i], along = sheet.axes[i];
    for (int f = 0; f < 6; ++f) {
      const int mate = topology.mate[6 * hex + f];
      if (f / 2 == along || mate < 0) continue;
      const auto [a, b] = edge_along(mesh.hexes[hex], f, along);
      reach(mate / 6, axis_of(mesh.hexes[mate / 6], a, b));
    }
  }
  return sheet;
}

void divide_sheet(PaddedMesh& padded, const TracedSheet& sheet, int parts) {
  HexMesh& mesh = padded.mesh;
  Association& association = padded.association;
  Rungs rungs(padded, parts);
  for (std::size_t i = 0; i < sheet.hexes.size(); ++i) {
    const Hex hex = mesh.hexes[sheet.hexes[i]];
    for (const auto& [c, d] : pairs_along(sheet.axes[i])) rungs.add(hex[c], hex[d]);
  }
  for (std::size_t i = 0; i < sheet.hexes.size(); ++i) {
    const Hex hex = mesh.hexes[sheet.hexes[i]];
    for (int k = 0; k < parts; ++k) {
      Hex part = hex;
      for (const auto& [c, d] : pairs_along(sheet.axes[i])) {
        part[c] = rungs.node(hex[c], hex[d], k);
        part[d] = rungs.node(hex[c], hex[d], k + 1);
      }
      if (k == 0) {
        mesh.hexes[sheet.hexes[i]] = part;
      } else {
        mesh.hexes.push_back(part);
      }
    }
  }
  for (std::size_t q = 0, count = association.quads.size(); q < count; ++q) {
    const Quad quad = association.quads[q];
    for (int first = 0; first < 2; ++first) {
      const int a = quad[first], b = quad[first + 1], c = quad[first + 2], d = quad[(first + 3) % 4];
      if (!rungs.find(a, b) || !rungs.find(d, c)) continue;
      for (const auto& [from, to] : {std::array{a, b}, std::array{d, c}}) rungs.classify(from, to, {2, association.quad_patch[q]});
      for (int k = 0; k < parts; ++k) {
        const Quad part{rungs.node(a, b, k), rungs.node(a, b, k + 1), rungs.node(d, c, k + 1), rungs.node(d, c, k)};
        if (k == 0) {
          association.quads[q] = part;
        } else {
          association.quads.push_back(part);
          association.quad_patch.push_back(association.quad_patch[q]);
        }
      }
      break;
    }
  }
  for (std::size_t s = 0, count = association.segments.size(); s < count; ++s) {
    const auto [a, b] = association.segments[s];
    if (!rungs.find(a, b)) continue;
    rungs.classify(a, b, {1, association.segment_edge[s]});
    for (int k = 0; k < parts; ++k) {
      const Segment part{rungs.node(a, b, k), rungs.node(a, b, k + 1)};
      if (k == 0) {
        association.segments[s] = part;
      } else {
        association.segments.push_back(part);
        association.segment_edge.push_back(association.segment_edge[s]);
      }
    }
  }
}

namespace {

// The CAD entity of nodes that become one; false where they stand on different ones.
bool join(const CadRef& other, CadRef& cad) {
  if (cad.dim == other.dim) return cad.dim > 2 || (cad.dim > 0 && cad.id == other.id);
  if (other.dim < cad.dim) cad = other;
  return true;
}

template <std::size_t N>
bool all_different(std::array<int, N> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
}

}  // namespace

bool collapse_sheet(PaddedMesh& padded, const TracedSheet& sheet, const std::vector<int>& edges) {
  const HexMesh& mesh = padded.mesh;
  const Association& a = padded.association;
  const int nodes = static_cast<int>(mesh.points.size());
  UnionFind same(static_cast<std::size_t>(nodes));
  std::vector<char> gone(mesh.hexes.size(), 0);
  for (std::size_t i = 0; i < sheet.hexes.size(); ++i) {
    const Hex& hex = mesh.hexes[sheet.hexes[i]];
    gone[sheet.hexes[i]] = 1;
    for (const auto& [c, d] : pairs_along(sheet.axes[i])) same.unite(hex[c], hex[d]);
  }
  PaddedMesh result{{}, {}, padded.fixed_faces};
  Association& left = result.association;
  left = a;
  left.point_cad.clear();
  std::vector<int> number(mesh.points.size(), -1), count;
  for (int v = 0; v < nodes; ++v) {
    int& at = number[same.find(v)];
    if (at < 0) {
      at = static_cast<int>(count.size());
      count.push_back(0);
      result.mesh.points.push_back(Vec3::Zero());
      left.point_cad.push_back(a.point_cad[v]);
    } else if (!join(a.point_cad[v], left.point_cad[at])) {
      return false;
    }
  }
  // Of nodes that become one the place is the mean of those on the entity.
  const auto of = [&](int v) { return number[same.find(v)]; };
  for (int v = 0; v < nodes; ++v) {
    if (a.point_cad[v].dim != left.point_cad[of(v)].dim) continue;
    result.mesh.points[of(v)] += mesh.points[v];
    ++count[of(v)];
  }
  for (std::size_t v = 0; v < count.size(); ++v) result.mesh.points[v] /= count[v];
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    if (gone[h]) continue;
    Hex hex = mesh.hexes[h];
    for (int& v : hex) v = of(v);
    if (!all_different(hex)) return false;
    result.mesh.hexes.push_back(hex);
    if (!padded.origin.empty()) result.origin.push_back(padded.origin[h]);
  }
  left.quads.clear();
  left.quad_patch.clear();
  for (std::size_t q = 0; q < a.quads.size(); ++q) {
    Quad quad = a.quads[q];
    for (int& v : quad) v = of(v);
    const bool flat = (quad[0] == quad[1] && quad[2] == quad[3]) || (quad[1] == quad[2] && quad[3] == quad[0]);
    if (flat) continue;
    if (!all_different(quad)) return false;
    left.quads.push_back(quad);
    left.quad_patch.push_back(a.quad_patch[q]);
  }
  left.segments.clear();
  left.segment_edge.clear();
  for (std::size_t s = 0; s < a.segments.size(); ++s) {
    const Segment segment{of(a.segments[s][0]), of(a.segments[s][1])};
    if (segment[0] == segment[1] && std::binary_search(edges.begin(), edges.end(), a.segment_edge[s])) continue;
    if (segment[0] == segment[1]) return false;
    left.segments.push_back(segment);
    left.segment_edge.push_back(a.segment_edge[s]);
  }
  if (!check(result.mesh, left).empty()) return false;
  padded = std::move(result);
  return true;
}

}  // namespace polycube
