#include "pad/room.h"

#include <algorithm>

#include "core/hexahedron.h"
#include "pad/sheet.h"
#include "pad/topology.h"
#include "pad/tuning.h"

namespace polycube {
namespace {

// A hex, seen from one of its corners with the three neighbours of that corner.
struct Seat {
  int hex = 0;
  int corner = 0;
  std::array<int, 3> ahead{};
};

// The side of a hex that has the corners a, b and c.
int side_with(int a, int b, int c) {
  for (int f = 0; f < 6; ++f) {
    const auto& face = kHexFaces[f];
    const auto has = [&](int x) { return std::find(face.begin(), face.end(), x) != face.end(); };
    if (has(a) && has(b) && has(c)) return f;
  }
  return -1;
}

// The next hex along direction d, -1 at the boundary.
Seat next(const HexMesh& mesh, const HexTopology& topology, const Seat& s, int d) {
  const Hex& hex = mesh.hexes[s.hex];
  const int e = (d + 1) % 3, f = (d + 2) % 3;
  // Opposite to the side that holds the corner and the other two directions.
  const int near = side_with(s.corner, s.ahead[e], s.ahead[f]);
  const int mate = topology.mate[6 * s.hex + (near ^ 1)];
  if (mate < 0) return {-1, 0, {}};
  const Hex& other = mesh.hexes[mate / 6];
  // The corner's neighbours e and f, moved one cell on, are the far neighbours of its neighbour d.
  const auto moved = [&](int neighbour) {
    for (int c : kCornerNeighbours[neighbour]) {
      const auto& across = kCornerNeighbours[s.ahead[d]];
      if (c != s.corner && std::find(across.begin(), across.end(), c) != across.end()) return hex[c];
    }
    return -1;
  };
  Seat result{mate / 6, corner_of(other, hex[s.ahead[d]]), {}};
  result.ahead[e] = corner_of(other, moved(s.ahead[e]));
  result.ahead[f] = corner_of(other, moved(s.ahead[f]));
  for (int c : kCornerNeighbours[result.corner]) {
    if (c != result.ahead[e] && c != result.ahead[f]) result.ahead[d] = c;
  }
  return result;
}

// The block of up to `width` cells each way from the corner under the quad; directions 0 and 1 lie in the quad.
SheetCut block(const HexMesh& mesh, const std::vector<Quad>& quads, const HexTopology& topology, const CrowdedCorner& corner, int width) {
  SheetCut cut{std::vector<char>(mesh.hexes.size(), 0), std::vector<char>(quads.size(), 0)};
  std::vector<char> open(quads.size(), 0);
  const int side = topology.quad_side[corner.quad];
  const Hex& hex = mesh.hexes[side / 6];
  Seat first{side / 6, corner_of(hex, corner.node), {}};
  int in_quad = 0;
  for (int c : kCornerNeighbours[first.corner]) {
    const auto& face = kHexFaces[side % 6];
    first.ahead[std::find(face.begin(), face.end(), c) != face.end() ? in_quad++ : 2] = c;
  }
  Seat a = first;
  for (int i = 0; i < width && a.hex >= 0; ++i, a = next(mesh, topology, a, 0)) {
    Seat b = a;
    for (int j = 0; j < width && b.hex >= 0; ++j, b = next(mesh, topology, b, 1)) {
      const int top = topology.mate[6 * b.hex + side_with(b.corner, b.ahead[0], b.ahead[1])];
      if (top >= 0) break;  // the surface turns away
      open[-1 - top] = 1;
      Seat c = b;
      for (int k = 0; k < width && c.hex >= 0; ++k, c = next(mesh, topology, c, 2)) cut.inside[c.hex] = 1;
    }
  }
  for (std::size_t q = 0; q < quads.size(); ++q) cut.surface[q] = cut.inside[topology.quad_side[q] / 6] && !open[q];
  return cut;
}

}  // namespace

int make_room(HexMesh& mesh, RoomySurface surface, const CrowdedCorner& corner) {
  // A layer made for a corner nearby may have moved the quad off the node.
  const Quad& crowded = surface.quads[corner.quad];
  if (std::find(crowded.begin(), crowded.end(), corner.node) == crowded.end()) return 0;
  const HexTopology topology = build_topology(mesh, surface.quads);
  // The layer is made on the bare grid: one patch, no chains.
  Association bare;
  bare.patches = {{}};
  bare.quads = surface.quads;
  bare.quad_patch.assign(surface.quads.size(), 0);
  bare.point_cad.assign(mesh.points.size(), CadRef{3, 1});
  for (const Quad& q : surface.quads) {
    for (int n : q) bare.point_cad[n] = {2, 0};
  }
  for (int width = kPadTuning.room_width; width > 0; --width) {
    const SheetCut cut = block(mesh, surface.quads, topology, corner, width);
    OpenedMesh opened = open_sheet(mesh, bare, cut, topology);
    if (!opened.obstacles.empty()) continue;
    mesh = std::move(opened.mesh);
    surface.quads = std::move(opened.association.quads);
    for (int q : opened.beside) {
      surface.quad_chart.push_back(surface.quad_chart[q]);
      surface.quad_triangle.push_back(surface.quad_triangle[q]);
    }
    return opened.added;
  }
  return 0;
}

}  // namespace polycube
