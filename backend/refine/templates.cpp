#include "refine/templates.h"

#include <algorithm>
#include <optional>

#include "core/hexahedron.h"

namespace polycube {
namespace {

// The two nodes in a face with one divided edge stand this far from it, in thirds: of a half, .6 and two thirds the last gives the best cells (.46 in a cube;
// optimal with one place free each are .48).
constexpr int kFar = 2;

bool has(CornerSet set, int corner) { return (set >> corner) & 1; }

CornerSet face_set(int face) {
  CornerSet set = 0;
  for (const int c : kHexFaces[face]) set = static_cast<CornerSet>(set | (1 << c));
  return set;
}

/// Edges with both ends in the set.
std::vector<std::array<int, 2>> edges_in(CornerSet set) {
  std::vector<std::array<int, 2>> edges;
  for (const auto& edge : kHexEdges) {
    if (has(set, edge[0]) && has(set, edge[1])) edges.push_back(edge);
  }
  return edges;
}

/// A corner with its right-handed neighbours: the origin and the directions u, v, w of a template.
struct Frame {
  int origin = 0;
  std::array<int, 3> towards{1, 3, 4};
  /// 0, 1, 2: the cell's own direction that the template's u, v or w goes along.
  int axis(int direction) const {
    int a = 0;
    while (kCornerCoordinates[origin][a] == kCornerCoordinates[towards[direction]][a]) ++a;
    return a;
  }
};

/// The frame at `origin` with the neighbour `first` along u.
Frame frame_at(int origin, int first) {
  Frame frame{origin, kCornerNeighbours[origin]};
  while (frame.towards[0] != first) std::rotate(frame.towards.begin(), frame.towards.begin() + 1, frame.towards.end());
  return frame;
}

CellPart turned(const CellPart& part, const Frame& frame) {
  CellPart result;
  for (int c = 0; c < 8; ++c) {
    const auto& origin = kCornerCoordinates[frame.origin];
    for (int a = 0; a < 3; ++a) {
      int x = 3 * origin[a];
      for (int d = 0; d < 3; ++d) x += part[c][d] * (kCornerCoordinates[frame.towards[d]][a] - origin[a]);
      result[c][a] = x;
    }
  }
  return result;
}

using Corners = std::array<CellPlace, 4>;

CellPart between(const Corners& bottom, const Corners& top) { return {bottom[0], bottom[1], bottom[2], bottom[3], top[0], top[1], top[2], top[3]}; }

/// A box of nu x nv x nw parts.
std::vector<CellPart> box_parts(const std::array<bool, 3>& divided) {
  std::vector<CellPart> parts;
  std::array<int, 3> count, step;
  for (int d = 0; d < 3; ++d) {
    count[d] = divided[d] ? 3 : 1;
    step[d] = 3 / count[d];
  }
  for (int k = 0; k < count[2]; ++k) {
    for (int j = 0; j < count[1]; ++j) {
      for (int i = 0; i < count[0]; ++i) {
        CellPart part;
        for (int c = 0; c < 8; ++c) {
          const auto& x = kCornerCoordinates[c];
          part[c] = {(i + x[0]) * step[0], (j + x[1]) * step[1], (k + x[2]) * step[2]};
        }
        parts.push_back(part);
      }
    }
  }
  return parts;
}

/// The four parts of the face v = 0 (u, w) whose edge w = 0 is divided, drawn out along v.
std::vector<CellPart> wall_parts() {
  const auto at = [](int u, int v, int w) { return CellPlace{u, v, w}; };
  std::vector<CellPart> parts;
  const std::array<std::array<std::array<int, 2>, 4>, 4> quads{{{{{0, 0}, {1, 0}, {1, kFar}, {0, 3}}},
                                                                {{{1, 0}, {2, 0}, {2, kFar}, {1, kFar}}},
                                                                {{{2, 0}, {3, 0}, {3, 3}, {2, kFar}}},
                                                                {{{0, 3}, {1, kFar}, {2, kFar}, {3, 3}}}}};
  for (const auto& quad : quads) {
    Corners near, far;
    for (int k = 0; k < 4; ++k) {
      near[k] = at(quad[k][0], 0, quad[k][1]);
      far[k] = at(quad[k][0], 3, quad[k][1]);
    }
    parts.push_back(between(far, near));
  }
  return parts;
}

/// The face w = 0 in nine. First along u, as wall_parts() does; then the three parts that stand on the face likewise along v.
std::vector<CellPart> face_parts() {
  // Across each of the four lines u = 0 to 3 of the face a wall of four quads.
  const auto wall = [](int u) {
    const bool outer = u == 0 || u == 3;
    const int side = outer ? kFar : 1, top = outer ? 3 : kFar;
    const auto at = [&](int v, int w) { return CellPlace{u, v, w}; };
    return std::array<Corners, 4>{Corners{at(0, 0), at(1, 0), at(1, side), at(0, top)}, Corners{at(1, 0), at(2, 0), at(2, side), at(1, side)},
                                  Corners{at(2, 0), at(3, 0), at(3, top), at(2, side)}, Corners{at(0, top), at(1, side), at(2, side), at(3, top)}};
  };
  std::vector<CellPart> parts;
  for (int u = 0; u < 3; ++u) {
    const auto low = wall(u), high = wall(u + 1);
    for (int k = 0; k < 4; ++k) parts.push_back(between(low[k], high[k]));
  }
  parts.push_back(wall_parts().back());
  return parts;
}

/// The edge v = w = 0 in three.
std::vector<CellPart> edge_parts() {
  const auto line = [](int v, int w) { return std::array<CellPlace, 2>{CellPlace{1, v, w}, CellPlace{2, v, w}}; };
  const auto p = line(0, 0), q = line(kFar, 0), s = line(0, kFar), r = line(kFar, kFar);
  const CellPlace a{0, 0, 0}, b{3, 0, 0}, c{3, 3, 0}, d{0, 3, 0}, e{0, 0, 3}, f{3, 0, 3}, g{3, 3, 3}, h{0, 3, 3};
  return {{p[0], p[1], q[1], q[0], s[0], s[1], r[1], r[0]},
          {a, p[0], q[0], d, e, s[0], r[0], h},
          {p[1], b, c, q[1], s[1], f, g, r[1]},
          {q[0], q[1], c, d, r[0], r[1], g, h},
          {s[0], s[1], r[1], r[0], e, f, g, h}};
}

std::optional<int> face_of(CornerSet corners) {
  for (int f = 0; f < 6; ++f) {
    if ((corners & ~face_set(f)) == 0) return f;
  }
  return std::nullopt;
}

}  // namespace

CornerSet with_template(CornerSet corners) {
  if (edges_in(corners).size() < 2) return corners;
  const std::optional<int> face = face_of(corners);
  return face ? face_set(*face) : kAllCorners;
}

std::vector<CellPart> cell_parts(CornerSet corners, const std::array<bool, 3>& divided) {
  std::vector<CellPart> whole = box_parts({false, false, false});
  if (corners == kAllCorners) return box_parts(divided);
  const std::vector<std::array<int, 2>> edges = edges_in(corners);
  if (edges.empty()) return whole;
  std::vector<CellPart> parts;
  Frame frame;
  if (edges.size() == 1) {
    frame = frame_at(edges[0][0], edges[0][1]);
    if (!divided[frame.axis(0)]) return whole;
    parts = edge_parts();
  } else {
    // Of the face's corners the first whose u, with w going away from the face, is divided.
    const auto& around = kHexFaces[*face_of(corners)];
    const auto found = std::find_if(around.begin(), around.end(), [&](int c) {
      const auto& beside = kCornerNeighbours[c];
      const auto away = static_cast<std::size_t>(std::find_if(beside.begin(), beside.end(), [&](int n) { return !has(corners, n); }) - beside.begin());
      frame = frame_at(c, beside[(away + 1) % 3]);
      return divided[frame.axis(0)];
    });
    if (found == around.end()) return whole;
    parts = divided[frame.axis(1)] ? face_parts() : wall_parts();
  }
  for (CellPart& part : parts) part = turned(part, frame);
  return parts;
}

}  // namespace polycube
