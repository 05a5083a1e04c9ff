#include "pad/concentric.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/union_find.h"
#include "pad/angles.h"
#include "pad/divide.h"
#include "pad/surface.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

// CAD faces on one cylinder.
struct RoundWall {
  std::vector<int> faces;  // ascending
  Vec3 axis, centre;
  double radius = 0;
  bool bore = false;  // material outside
};

// Faces of one cylinder, by size.
std::vector<RoundWall> round_walls(const CadModel& model) {
  std::vector<RoundWall> walls;
  for (const int id : model.faces()) {
    const CadFace& face = model.face(id);
    if (face.kind != SurfaceKind::kCylinder || face.edges.empty()) continue;
    const CadEdge& border = model.edge(face.edges[0]);
    const Vec3 at = model.project_to_face(id, border.vertices[0] > 0 ? model.vertex(border.vertices[0]) : face.centre).point;
    const Vec2 uv = model.project_to_face(id, at).uv;
    const Vec3 out = at - face.centre - face.axis * face.axis.dot(at - face.centre);
    const bool bore = model.face_normal(id, uv).dot(out) < 0;
    const double same = kPadTuning.same_axis * face.radius;
    const auto is_on = [&](const RoundWall& wall) {
      const Vec3 apart = face.centre - wall.centre;
      return wall.bore == bore && std::abs(wall.radius - face.radius) < same && wall.axis.cross(face.axis).norm() < kPadTuning.same_axis &&
             wall.axis.cross(apart).norm() < same;
    };
    const auto known = std::find_if(walls.begin(), walls.end(), is_on);
    if (known != walls.end()) {
      known->faces.push_back(id);
    } else {
      walls.push_back({{id}, face.axis, face.centre, face.radius, bore});
    }
  }
  std::stable_sort(walls.begin(), walls.end(), [](const RoundWall& a, const RoundWall& b) { return a.radius < b.radius; });
  return walls;
}

class Concentric {
 public:
  Concentric(const CadModel& model, PaddedMesh& padded, const RingOptions& options, const Monitor& monitor)
      : model_(model), padded_(padded), options_(options), monitor_(monitor), walls_(round_walls(model)) {
    renew();
  }

  int run() {
    int count = 0;
    for (const RoundWall& wall : walls_) {
      if (!options_.radial || wall.bore) continue;
      const std::size_t pieces = pieces_of(wall).size();
      for (std::size_t i = 0; i < pieces; ++i) count += straighten_tube(wall, i);
    }
    for (const RoundWall& wall : walls_) {
      const std::size_t pieces = pieces_of(wall).size();
      for (std::size_t i = 0; i < pieces; ++i) {
        monitor_.check();
        // Rings round one piece renumber none of the others' first quads.
        count += !wall.bore ? ring_core(wall, i) : !is_left(wall) && ring_bore(wall, i);
      }
    }
    return count;
  }

 private:
  using Quads = std::vector<int>;

  void renew() { topology_ = build_topology(padded_.mesh, padded_.association.quads); }

  Vec3 across(const RoundWall& wall, const Vec3& v) const { return v - wall.axis * wall.axis.dot(v); }

  void mark_patches(const RoundWall& wall, std::vector<char>& patches) const {
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const std::vector<int>& faces = padded_.association.patches[p];
      if (std::includes(wall.faces.begin(), wall.faces.end(), faces.begin(), faces.end())) patches[p] = 1;
    }
  }

  bool is_left(const RoundWall& wall) const {
    const auto left = [&](int e) { return std::binary_search(options_.left_edges.begin(), options_.left_edges.end(), e); };
    return std::any_of(wall.faces.begin(), wall.faces.end(),
                       [&](int f) { return std::any_of(model_.face(f).edges.begin(), model_.face(f).edges.end(), left); });
  }

  // The quads on the wall, those that hang together in one list, by the first of each.
  std::vector<Quads> pieces_of(const RoundWall& wall) const {
    const Association& a = padded_.association;
    std::vector<char> on_wall(a.patches.size(), 0);
    for (std::size_t p = 0; p < a.patches.size(); ++p)
      on_wall[p] = std::includes(wall.faces.begin(), wall.faces.end(), a.patches[p].begin(), a.patches[p].end());
    UnionFind sets(static_cast<int>(padded_.mesh.points.size()));
    for (std::size_t q = 0; q < a.quads.size(); ++q) {
      if (!on_wall[a.quad_patch[q]]) continue;
      for (int k = 1; k < 4; ++k) sets.unite(a.quads[q][0], a.quads[q][k]);
    }
    std::vector<Quads> pieces;
    std::vector<int> piece_of(padded_.mesh.points.size(), -1);
    for (std::size_t q = 0; q < a.quads.size(); ++q) {
      if (!on_wall[a.quad_patch[q]]) continue;
      int& piece = piece_of[sets.find(a.quads[q][0])];
      if (piece < 0) {
        piece = static_cast<int>(pieces.size());
        pieces.emplace_back();
      }
      pieces[piece].push_back(static_cast<int>(q));
    }
    return pieces;
  }

  Vec3 centre_of_side(int side) const {
    Vec3 sum = Vec3::Zero();
    for (const int c : kHexFaces[side % 6]) sum += padded_.mesh.points[padded_.mesh.hexes[side / 6][c]] / 4;
    return sum;
  }

  // Radians round the axis without a quad.
  double gap(const RoundWall& wall, const Quads& quads) const {
    const Vec3 u = wall.axis.unitOrthogonal(), v = wall.axis.cross(u);
    std::vector<double> angles;
    for (const int q : quads) {
      const Vec3 at = centre_of_side(topology_.quad_side[q]) - wall.centre;
      angles.push_back(std::atan2(at.dot(v), at.dot(u)));
    }
    std::sort(angles.begin(), angles.end());
    angles.push_back(angles.front() + 2 * std::numbers::pi);
    double widest = 0;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) widest = std::max(widest, angles[i + 1] - angles[i]);
    return widest;
  }
  bool full_turn(const RoundWall& wall, const Quads& quads) const { return gap(wall, quads) < kPadTuning.widest_gap; }

  // Whether a piece of a bore, as symmetry leaves it, ends at edges only at which layers can end: a fillet does not.
  bool ends_sharply(const Quads& quads) const {
    const auto edges = boundary_edges(padded_.mesh, padded_.association.quads, topology_);
    const auto angles = dihedral_angles(model_, padded_.mesh, padded_.association, edges);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const auto is_on = [&](int q) { return std::binary_search(quads.begin(), quads.end(), q); };
      if (is_on(edges[e].quads[0]) == is_on(edges[e].quads[1])) continue;
      if (angles[e] > kPadTuning.widest_end && angles[e] < kPadTuning.concave) return false;
    }
    return true;
  }

  // Mesh edges round the circle.
  double elements_round(const RoundWall& wall, const Quads& quads) const {
    double sum = 0;
    int count = 0;
    for (const int q : quads) {
      const Quad& quad = padded_.association.quads[q];
      for (int k = 0; k < 4; ++k) {
        const Vec3 edge = padded_.mesh.points[quad[(k + 1) % 4]] - padded_.mesh.points[quad[k]];
        const double round = across(wall, edge).norm();
        if (round < edge.norm() / 2) continue;
        sum += round;
        ++count;
      }
    }
    return count > 0 && sum > 0 ? 2 * std::numbers::pi * wall.radius * count / sum : 0;
  }

  // The cells on the way from a boundary quad straight into the solid, to the boundary again.
  struct Column {
    int cells = 0;
    double length = 0;
    int quad = -1;  // at its end
  };
  Column column(int quad) const {
    Column result;
    for (int side = topology_.quad_side[quad]; result.cells <= static_cast<int>(padded_.mesh.hexes.size());) {
      const int opposite = 6 * (side / 6) + (side % 6 ^ 1);
      result.length += (centre_of_side(opposite) - centre_of_side(side)).norm();
      ++result.cells;
      side = topology_.mate[opposite];
      if (side < 0) {
        result.quad = -1 - side;
        break;
      }
    }
    return result;
  }

  // Least and most hexes at edges inside the piece.
  std::pair<int, int> hexes_at_edges(const Quads& quads) const {
    std::pair<int, int> result{2, 2};
    for (const BoundaryEdge& e : boundary_edges(padded_.mesh, padded_.association.quads, topology_)) {
      if (!std::binary_search(quads.begin(), quads.end(), e.quads[0]) || !std::binary_search(quads.begin(), quads.end(), e.quads[1])) continue;
      result.first = std::min(result.first, e.hexes);
      result.second = std::max(result.second, e.hexes);
    }
    return result;
  }

  // Divides the layer under the quads, where it is theirs, and spreads what is about it.
  bool divide(const RoundWall& wall, const Quads& quads, int parts, int depth) {
    const TracedSheet sheet = trace_sheet(padded_.mesh, topology_, topology_.quad_side[quads[0]]);
    if (!sheet.simple) return false;
    // One layer may lie under several cylinders, as in a stepped shaft; under much else it is not for them to divide.
    std::vector<int> under;
    for (std::size_t i = 0; i < sheet.hexes.size(); ++i) {
      for (int f = 2 * sheet.axes[i]; f < 2 * sheet.axes[i] + 2; ++f) {
        const int mate = topology_.mate[6 * sheet.hexes[i] + f];
        if (mate < 0) under.push_back(-1 - mate);
      }
    }
    std::sort(under.begin(), under.end());
    if (!std::includes(under.begin(), under.end(), quads.begin(), quads.end())) return false;
    std::vector<char> on_like(padded_.association.patches.size(), 0);
    for (const RoundWall& other : walls_) {
      if (other.bore == wall.bore) mark_patches(other, on_like);
    }
    const auto own = std::count_if(under.begin(), under.end(), [&](int q) { return on_like[padded_.association.quad_patch[q]]; });
    if (static_cast<double>(own) < kPadTuning.own_share * static_cast<double>(under.size())) return false;
    divided_.insert(under.begin(), under.end());
    const std::size_t hexes = padded_.mesh.hexes.size();
    divide_sheet(padded_, sheet, parts);
    renew();
    if (!padded_.origin.empty()) add_origin(hexes);
    spread(wall, sheet, depth);
    return true;
  }

  // Takes the nodes of the sheet and within so many cells of it to the means of their neighbours across the axis, those of patches along these. Nodes on the
  // wall and on CAD edges stay.
  void spread(const RoundWall& wall, const TracedSheet& sheet, int depth) {
    HexMesh& mesh = padded_.mesh;
    const Association& a = padded_.association;
    std::vector<char> reached(mesh.points.size(), 0);
    std::vector<int> nodes;
    for (const int h : sheet.hexes) {
      for (const int v : mesh.hexes[h]) {
        if (!std::exchange(reached[v], 1)) nodes.push_back(v);
      }
    }
    for (std::size_t i = 0, end = nodes.size(); depth > 0; --depth, end = nodes.size()) {
      for (; i < end; ++i) {
        for (int k = topology_.node_first[nodes[i]]; k < topology_.node_first[nodes[i] + 1]; ++k) {
          for (const int v : mesh.hexes[topology_.node_hexes[k]]) {
            if (!std::exchange(reached[v], 1)) nodes.push_back(v);
          }
        }
      }
    }
    std::vector<char> free(mesh.points.size(), 0);
    for (const int v : nodes) {
      const CadRef& cad = a.point_cad[v];
      if (cad.dim < 2) continue;
      if (cad.dim == 2 && std::includes(wall.faces.begin(), wall.faces.end(), a.patches[cad.id].begin(), a.patches[cad.id].end())) continue;
      free[v] = 1;
    }
    std::sort(nodes.begin(), nodes.end());
    std::erase_if(nodes, [&](int v) { return !free[v]; });
    std::vector<std::vector<int>> neighbours(nodes.size());
    const auto slot = [&](int v) { return std::lower_bound(nodes.begin(), nodes.end(), v) - nodes.begin(); };
    const auto join = [&](int v, int other, int dim) {
      if (free[v] && a.point_cad[v].dim == dim) neighbours[slot(v)].push_back(other);
    };
    for (const Quad& quad : a.quads) {
      for (int k = 0; k < 4; ++k) {
        join(quad[k], quad[(k + 1) % 4], 2);
        join(quad[(k + 1) % 4], quad[k], 2);
      }
    }
    for (const Hex& hex : mesh.hexes) {
      for (const auto& [c, d] : kHexEdges) {
        join(hex[c], hex[d], 3);
        join(hex[d], hex[c], 3);
      }
    }
    for (std::vector<int>& list : neighbours) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    for (int round = 0; round < kPadTuning.spread_rounds; ++round) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (neighbours[i].empty()) continue;
        Vec3 mean = Vec3::Zero();
        for (const int v : neighbours[i]) mean += mesh.points[v];
        mean /= static_cast<double>(neighbours[i].size());
        mesh.points[nodes[i]] += across(wall, mean - mesh.points[nodes[i]]);
      }
    }
  }

  bool ring_bore(const RoundWall& wall, std::size_t piece) {
    Quads quads = pieces_of(wall)[piece];
    const double round = elements_round(wall, quads);
    const double turn = 2 * std::numbers::pi * (1 + 1 / round) - gap(wall, quads);
    if (turn < kPadTuning.least_arc || (!full_turn(wall, quads) && !ends_sharply(quads))) return false;
    if (divided_.contains(quads[0]) || round < kPadTuning.least_round) return false;
    // One row of cells along the bore would be one through the rings.
    if (static_cast<double>(quads.size()) < kPadTuning.bore_rows * round * turn / (2 * std::numbers::pi)) return false;
    for (const int q : quads) {
      if (column(q).length < kPadTuning.bore_room * wall.radius) return false;
    }
    const auto [least, most] = hexes_at_edges(quads);
    if (least < 2) return false;
    if (most > 2) {
      std::vector<char> region(padded_.association.quads.size(), 0);
      for (const int q : quads) region[q] = 1;
      const std::size_t hexes = padded_.mesh.hexes.size();
      if (!insert_layer_under(model_, padded_, region)) return false;
      renew();
      if (!padded_.origin.empty()) add_origin(hexes);
      quads = pieces_of(wall)[piece];
    }
    const int parts = std::clamp(static_cast<int>(std::ceil(kPadTuning.ring_share * round / (2 * std::numbers::pi))), 2, kPadTuning.most_rings);
    return divide(wall, quads, parts, kPadTuning.spread_depth) || most > 2;
  }

  bool ring_core(const RoundWall& wall, std::size_t piece) {
    const Quads quads = pieces_of(wall)[piece];
    if (divided_.contains(quads[0]) || !full_turn(wall, quads) || hexes_at_edges(quads) != std::pair{2, 2}) return false;
    std::vector<int> cells;
    for (const int q : quads) {
      const Column found = column(q);
      if (!std::binary_search(quads.begin(), quads.end(), found.quad)) return false;  // a tube
      cells.push_back(found.cells);
    }
    std::nth_element(cells.begin(), cells.begin() + static_cast<long>(cells.size() / 2), cells.end());
    const int core = cells[cells.size() / 2] - 2;
    if (core > kPadTuning.most_core) return false;
    const int parts = std::max(2, static_cast<int>(std::ceil(kPadTuning.core_share * core)));
    return divide(wall, quads, parts, core / 2 + 1);
  }

  // The grid's hex that each hex comes from or, of those laid under walls, is nearest to.
  void note_origin() {
    if (!padded_.origin.empty()) return;
    padded_.origin.resize(options_.grid_cells);
    std::iota(padded_.origin.begin(), padded_.origin.end(), 0);
    add_origin(options_.grid_cells);
  }

  const RoundWall* bore_in(const RoundWall& wall) const {
    const auto inside = [&](const RoundWall& other) {
      return other.bore && other.radius < wall.radius && wall.radius < kPadTuning.thick_tube * other.radius &&
             other.axis.cross(wall.axis).norm() < kPadTuning.same_axis &&
             other.axis.cross(wall.centre - other.centre).norm() < kPadTuning.same_axis * other.radius;
    };
    const auto found = std::find_if(walls_.begin(), walls_.end(), inside);
    return found == walls_.end() ? nullptr : &*found;
  }

  // The grid of a tube is a square in a square; without the rows between their sides only rings are left.
  bool straighten_tube(const RoundWall& wall, std::size_t piece) {
    const RoundWall* bore = bore_in(wall);
    if (!bore) return false;
    const PaddedMesh before = padded_;
    if (try_straighten(wall, piece, *bore)) return true;
    padded_ = before;
    renew();
    return false;
  }

  bool try_straighten(const RoundWall& wall, std::size_t piece, const RoundWall& bore) {
    const auto quads = [&] { return pieces_of(wall)[piece]; };
    if (!full_turn(wall, quads()) || hexes_at_edges(quads()) != std::pair{2, 2}) return false;
    const std::vector<Quads> bores = pieces_of(bore);
    if (bores.size() != 1 || !full_turn(bore, bores[0])) return false;
    const double round = elements_round(bore, bores[0]);
    if (round < kPadTuning.radial_round || (options_.longest > 0 && 2 * std::numbers::pi * wall.radius > options_.longest * round)) return false;
    // Every column goes to the bore or, at the corners of the grid, to the wall again.
    int across = 0;
    for (const int q : quads()) {
      const Column found = column(q);
      if (std::binary_search(bores[0].begin(), bores[0].end(), found.quad)) {
        across = std::max(across, found.cells);
      } else if (const Quads all = quads(); !std::binary_search(all.begin(), all.end(), found.quad)) {
        return false;
      }
    }
    if (across < 2) return false;
    note_origin();
    if (hexes_at_edges(bores[0]).second > 2) {
      std::vector<char> region(padded_.association.quads.size(), 0);
      for (const int q : bores[0]) region[q] = 1;
      const std::size_t hexes = padded_.mesh.hexes.size();
      if (!insert_layer_under(model_, padded_, region)) return false;
      renew();
      add_origin(hexes);
    }
    // Edges of walls of the same tube may lose cells, others need theirs.
    std::vector<int> edges;
    for (const RoundWall& other : walls_) {
      if (other.bore || bore_in(other) != &bore) continue;
      for (const int f : other.faces) edges.insert(edges.end(), model_.face(f).edges.begin(), model_.face(f).edges.end());
    }
    std::sort(edges.begin(), edges.end());
    // The sheets between the layer under the wall and the one round the bore go straight from wall to wall.
    for (bool again = true; again;) {
      again = false;
      monitor_.check();
      const Quads at_bore = pieces_of(bore)[0];
      for (const int q : quads()) {
        const Column found = column(q);
        if (found.cells == 2 || !std::binary_search(at_bore.begin(), at_bore.end(), found.quad)) continue;
        const int first = topology_.quad_side[q], side = topology_.mate[6 * (first / 6) + (first % 6 ^ 1)];
        const TracedSheet sheet = trace_sheet(padded_.mesh, topology_, side);
        if (!sheet.simple || !collapse_sheet(padded_, sheet, edges)) return false;
        renew();
        again = true;
        break;
      }
    }
    const Quads at_bore = pieces_of(bore)[0], at_wall = quads();
    for (const int q : at_wall) {
      const Column found = column(q);
      if (found.cells != 2 || !std::binary_search(at_bore.begin(), at_bore.end(), found.quad)) return false;
      face_bore(wall, q);
    }
    return across == 2 || divide(bore, at_bore, across - 1, across);
  }

  // Divided hexes come from where the others of their sheet, or those beside them, do.
  void add_origin(std::size_t hexes) {
    std::vector<int>& origin = padded_.origin;
    std::vector<int> front(hexes);
    std::iota(front.begin(), front.end(), 0);
    origin.resize(padded_.mesh.hexes.size(), -1);
    for (std::size_t i = 0; i < front.size(); ++i) {
      for (int f = 0; f < 6; ++f) {
        const int mate = topology_.mate[6 * front[i] + f];
        if (mate < 0 || origin[mate / 6] >= 0) continue;
        origin[mate / 6] = origin[front[i]];
        front.push_back(mate / 6);
      }
    }
  }

  // Takes the nodes of a quad on the wall to where those of the bore look.
  void face_bore(const RoundWall& wall, int quad) {
    HexMesh& mesh = padded_.mesh;
    const int outer = topology_.quad_side[quad];
    for (int k = 0; k < 4; ++k) {
      int node = mesh.hexes[outer / 6][kHexFaces[outer % 6][k]];
      const int start = node;
      for (int side = outer; side >= 0;) {
        const Hex& hex = mesh.hexes[side / 6];
        const int opposite = 6 * (side / 6) + (side % 6 ^ 1);
        for (const int c : kCornerNeighbours[corner_of(hex, node)]) {
          const auto& far = kHexFaces[opposite % 6];
          if (std::find(far.begin(), far.end(), c) == far.end()) continue;
          node = hex[c];
          break;
        }
        side = topology_.mate[opposite];
      }
      if (padded_.association.point_cad[start].dim == 0) continue;
      const Vec3 from = mesh.points[node] - wall.centre;
      mesh.points[start] += wall.radius * across(wall, from).normalized() - across(wall, mesh.points[start] - wall.centre);
    }
  }

  const CadModel& model_;
  PaddedMesh& padded_;
  const RingOptions& options_;
  const Monitor& monitor_;
  std::vector<RoundWall> walls_;
  HexTopology topology_;
  std::set<int> divided_;  // quads under which the layer was divided
};

}  // namespace

int insert_concentric(const CadModel& model, PaddedMesh& padded, const RingOptions& options, const Monitor& monitor) {
  const int count = Concentric(model, padded, options, monitor).run();
  if (count == 0) return 0;
  const auto faults = check(padded.mesh, padded.association);
  if (!faults.empty()) throw StageFailed("pad", "rings broke the mesh: " + faults[0]);
  return count;
}

int count_cut_offs(const CadModel& model, const PaddedMesh& padded) {
  const Association& a = padded.association;
  int count = 0;
  for (const RoundWall& wall : round_walls(model)) {
    const auto on_wall = [&](const std::vector<int>& patch) { return patch.size() == 1 && std::binary_search(wall.faces.begin(), wall.faces.end(), patch[0]); };
    for (std::size_t q = 0; q < a.quads.size(); ++q) {
      if (!on_wall(a.patches[a.quad_patch[q]])) continue;
      std::array<Vec3, 4> out;
      for (int k = 0; k < 4; ++k) {
        const Vec3 arm = padded.mesh.points[a.quads[q][k]] - wall.centre;
        out[k] = (arm - arm.dot(wall.axis) * wall.axis).normalized();
      }
      bool cuts = false;
      for (int k = 0; k < 4; ++k) {
        for (int other = 0; other < k; ++other) cuts = cuts || out[k].dot(out[other]) < kPadTuning.cut_off;
      }
      count += cuts;
    }
  }
  return count;
}

}  // namespace polycube
