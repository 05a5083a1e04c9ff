#include "pad/angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/hexahedron.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

constexpr double kPi = std::numbers::pi;

double dihedral_angle(const CadModel& model, int id, const Vec3& p) {
  const CadEdge& edge = model.edge(id);
  const double mean = (edge.min_angle + edge.max_angle) / 2;
  if (edge.max_angle - edge.min_angle < kPi / 18 || edge.seam) return mean;
  const Vec3 on = model.project_to_edge(id, p).point;
  std::array<Vec3, 2> normals;
  for (int k = 0; k < 2; ++k) normals[k] = model.face_normal(edge.faces[k], model.project_to_face(edge.faces[k], on).uv);
  const double turn = std::acos(std::clamp(normals[0].dot(normals[1]), -1.0, 1.0));
  const auto beyond = [&](double angle) { return std::max({edge.min_angle - angle, angle - edge.max_angle, 0.0}); };
  return beyond(kPi - turn) <= beyond(kPi + turn) ? kPi - turn : kPi + turn;
}

// A CAD edge as it leaves a CAD vertex.
struct Leaving {
  Vec3 tangent;
  Vec3 chord;  // to the point at `reach` along it
};

// `towards` tells the two ends of a closed edge apart.
Leaving leave(const CadModel& model, int id, int vertex, const Vec3& towards, double reach) {
  const CadEdge& edge = model.edge(id);
  const auto [begin, end] = model.edge_range(id);
  bool from_start = edge.vertices[0] == vertex;
  if (from_start && edge.vertices[1] == vertex) {
    const double t = model.project_to_edge(id, towards).t;
    from_start = t - begin <= end - t;
  }
  const double step = (end - begin) * std::min(1.0, reach / edge.length);
  const Vec3 chord = model.edge_point(id, from_start ? begin + step : end - step) - model.vertex(vertex);
  return {from_start ? model.edge_tangent(id, begin) : Vec3(-model.edge_tangent(id, end)), chord};
}

// The face of a hex with corner c and its k-th and next neighbour.
int corner_face(int c, int k) {
  const int third = kCornerNeighbours[c][(k + 2) % 3];
  for (int axis = 0; axis < 3; ++axis) {
    if (kCornerCoordinates[c][axis] != kCornerCoordinates[third][axis]) return 2 * axis + kCornerCoordinates[c][axis];
  }
  return 0;
}

// Pairs of a wanted node inside a patch and a node beside it on the boundary, sorted.
std::vector<std::array<int, 2>> neighbours_inside_patches(const Association& association, const std::vector<char>& wanted) {
  std::vector<std::array<int, 2>> pairs;
  for (const Quad& quad : association.quads) {
    for (int k = 0; k < 4; ++k) {
      if (!wanted[quad[k]] || association.point_cad[quad[k]].dim != 2) continue;
      for (int d : {1, 3}) pairs.push_back({quad[k], quad[(k + d) % 4]});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// From 0 to 2 pi, counter-clockwise about the normal.
double turn(const Vec3& normal, const Vec3& from, const Vec3& to) {
  const double angle = std::atan2(normal.dot(from.cross(to)), from.dot(to));
  return angle > 0 ? angle : angle + 2 * kPi;
}

// Finds the CAD edge of a mesh edge that leaves one of the wanted nodes.
class SegmentFinder {
 public:
  SegmentFinder(const Association& association, const std::vector<char>& wanted) {
    for (std::size_t s = 0; s < association.segments.size(); ++s) {
      const auto [a, b] = association.segments[s];
      if (wanted[a]) ends_.push_back({a, b, association.segment_edge[s]});
      if (wanted[b]) ends_.push_back({b, a, association.segment_edge[s]});
    }
    std::sort(ends_.begin(), ends_.end());
  }
  // 0 if there is none.
  int operator()(int node, int neighbour) const {
    const auto it = std::lower_bound(ends_.begin(), ends_.end(), std::array{node, neighbour, -1});
    return it != ends_.end() && (*it)[0] == node && (*it)[1] == neighbour ? (*it)[2] : 0;
  }

 private:
  std::vector<std::array<int, 3>> ends_;  // node, neighbour along a CAD edge, edge
};

double corner_angle(const CadModel& model, const HexMesh& mesh, const Association& association, const Sector& sector, int first_edge, int last_edge) {
  const int vertex = association.point_cad[sector.node].id;
  const double reach = 0.3 * std::min(model.edge(first_edge).length, model.edge(last_edge).length);
  const Leaving from = leave(model, first_edge, vertex, mesh.points[sector.first], reach);
  const Leaving to = leave(model, last_edge, vertex, mesh.points[sector.last], reach);
  const auto& faces = association.patches[sector.patch];
  int face = faces[0];
  for (int f : model.edge(first_edge).faces) {
    if (std::find(faces.begin(), faces.end(), f) != faces.end()) face = f;
  }
  const Vec3 normal = model.vertex_normal(face, vertex);
  const double angle = turn(normal, from.tangent, to.tangent);
  // Edges that leave in one direction bound a cusp or nearly a full turn: their curvature tells which.
  return angle < kPadTuning.cusp || angle > 2 * kPi - kPadTuning.cusp ? turn(normal, from.chord, to.chord) : angle;
}

}  // namespace

double angle_cost(int cells, double angle) {
  const double each = angle / cells;
  if (each >= kPadTuning.widest) return 1000 * each / kPadTuning.widest;
  // A sharp corner of the CAD must not be cut up further: its cells come near to folding over.
  const double narrow = std::max(each, 0.01), needle = 20 * kPi / 180;
  // A second cell in a corner that is too narrow for one is a cell folded over: worse than a flat one.
  const double folded = angle < kPadTuning.one_cell ? 4000.0 * (cells - 1) : 0;
  return 1 / std::sin(narrow) - 1 + 20 * std::max(needle / narrow - 1, 0.0) + folded;
}

std::vector<double> dihedral_angles(const CadModel& model, const HexMesh& mesh, const Association& association, const std::vector<BoundaryEdge>& edges,
                                    const std::vector<char>& wanted) {
  std::vector<double> angles(edges.size(), kPi);
  for (std::size_t s = 0; s < association.segments.size(); ++s) {
    const auto [a, b] = association.segments[s];
    if (!wanted.empty() && !wanted[a] && !wanted[b]) continue;
    const int e = find_edge(edges, a, b);
    if (e >= 0) angles[e] = dihedral_angle(model, association.segment_edge[s], (mesh.points[a] + mesh.points[b]) / 2);
  }
  return angles;
}

std::vector<Sector> find_sectors(const CadModel& model, const HexMesh& mesh, const Association& association, const std::vector<char>& wanted) {
  // Corners of quads: node, neighbour where the corner begins, neighbour where it ends (counter-clockwise), quad.
  std::vector<std::array<int, 4>> corners;
  for (int q = 0; q < static_cast<int>(association.quads.size()); ++q) {
    const Quad& quad = association.quads[q];
    for (int k = 0; k < 4; ++k) {
      if (wanted[quad[k]]) corners.push_back({quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4], q});
    }
  }
  std::sort(corners.begin(), corners.end());
  const SegmentFinder cad_edge(association, wanted);
  std::vector<Sector> sectors;
  for (std::size_t i = 0; i < corners.size();) {
    std::size_t j = i;
    while (j < corners.size() && corners[j][0] == corners[i][0]) ++j;
    const int node = corners[i][0];
    const auto beginning_at = [&](int neighbour) {
      return std::find_if(corners.begin() + static_cast<long>(i), corners.begin() + static_cast<long>(j), [&](const auto& c) { return c[1] == neighbour; });
    };
    const auto none = corners.begin() + static_cast<long>(j);
    bool complete = true, has_edge = false;
    for (std::size_t k = i; k < j; ++k) {
      complete = complete && beginning_at(corners[k][2]) != none;
      has_edge = has_edge || cad_edge(node, corners[k][1]) > 0;
    }
    if (complete && !has_edge) {
      sectors.push_back({node, association.quad_patch[corners[i][3]], -1, -1, static_cast<int>(j - i), 2 * kPi});
    }
    for (std::size_t k = i; complete && k < j; ++k) {
      const int first_edge = cad_edge(node, corners[k][1]);
      if (first_edge == 0) continue;
      Sector sector{node, association.quad_patch[corners[k][3]], corners[k][1], corners[k][2], 1, kPi};
      while (cad_edge(node, sector.last) == 0) {
        sector.last = (*beginning_at(sector.last))[2];
        ++sector.quads;
      }
      if (sector.first == sector.last) {
        sector.angle = 2 * kPi;
      } else if (association.point_cad[node].dim == 0) {
        sector.angle = corner_angle(model, mesh, association, sector, first_edge, cad_edge(node, sector.last));
      }
      sectors.push_back(sector);
    }
    i = j;
  }
  return sectors;
}

double inner_corner_cost(const CadModel& model, const HexMesh& mesh, const Association& association, const HexTopology& topology,
                         const std::vector<char>& wanted) {
  const SegmentFinder cad_edge(association, wanted);
  const auto inside_patch = neighbours_inside_patches(association, wanted);
  const auto is_inside_patch = [&](int node, int neighbour) {
    return std::binary_search(inside_patch.begin(), inside_patch.end(), std::array{node, neighbour});
  };
  const auto is_inner = [&](std::size_t h, int c, int k) { return topology.mate[6 * h + corner_face(c, k)] >= 0; };
  const auto direction = [&](int edge, int node, int neighbour, int other) -> Vec3 {
    if (association.point_cad[node].dim == 1) {
      return model.project_to_edge(edge, mesh.points[neighbour]).point - model.project_to_edge(edge, mesh.points[node]).point;
    }
    const double reach = 0.3 * std::min(model.edge(edge).length, model.edge(other).length);
    return leave(model, edge, association.point_cad[node].id, mesh.points[neighbour], reach).chord;
  };
  double cost = 0;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const Hex& hex = mesh.hexes[h];
    for (int c = 0; c < 8; ++c) {
      const int node = hex[c];
      if (!wanted[node] || association.point_cad[node].dim > 2) continue;
      if (association.point_cad[node].dim == 2) {
        int neighbours = 0;
        for (const int n : kCornerNeighbours[c]) neighbours += is_inside_patch(node, hex[n]);
        if (neighbours > 1 && is_inner(h, c, 0) && is_inner(h, c, 1) && is_inner(h, c, 2)) cost += kPadTuning.sunk;
        continue;
      }
      for (int k = 0; k < 3; ++k) {
        const int a = hex[kCornerNeighbours[c][k]], b = hex[kCornerNeighbours[c][(k + 1) % 3]];
        const int first = cad_edge(node, a), second = cad_edge(node, b);
        if (first == 0 || second == 0 || !is_inner(h, c, k)) continue;
        const Vec3 from = direction(first, node, a, second), to = direction(second, node, b, first);
        const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
        // A chord takes some of the turn of a curved edge: such a cell is poor, not lost.
        cost += angle < kPadTuning.widest ? angle_cost(1, angle) : kPadTuning.flat_inside / std::max(std::sin(angle), 0.03);
      }
    }
  }
  return cost;
}

}  // namespace polycube
