#include "pipeline/conform_grid.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/sorted.h"
#include "pad/topology.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

std::vector<int> faces_of(const ConformalModel& model) {
  std::vector<int> faces;
  for (const auto& interface : model.interfaces) faces.push_back(interface.first);
  return faces;
}

bool is_interface(const std::vector<int>& interfaces, int face) { return std::binary_search(interfaces.begin(), interfaces.end(), face); }

[[noreturn]] void unlike(int face) { throw StageFailed("interfaces", "the two solids do not see their common face alike", {{2, face}}); }

}  // namespace

std::vector<int> solids_of_blocks(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& complex) {
  std::vector<int> result;
  for (const Block& block : complex.blocks) {
    Vec3 centre;
    for (int d = 0; d < 3; ++d) centre[d] = (map.charts[block.charts[d][0]].value + map.charts[block.charts[d][1]].value) / 2;
    // The tet whose image has the block's centre deepest inside: folds and layers of no volume have it nowhere.
    double deepest = -std::numeric_limits<double>::infinity();
    int solid = -1;
    for (const int t : block.tets) {
      Mat3 edges;
      const Vec3& origin = map.image[tets.tets[t][0]];
      for (int k = 0; k < 3; ++k) edges.col(k) = map.image[tets.tets[t][k + 1]] - origin;
      const double volume = edges.determinant();
      if (!(volume > 0)) continue;
      const Vec3 inside = edges.inverse() * (centre - origin);
      const double depth = std::min(inside.minCoeff(), 1 - inside.sum());
      if (depth > deepest) {
        deepest = depth;
        solid = tets.tet_solid[t];
      }
    }
    if (solid < 0) throw StageFailed("interfaces", "a block of the grid belongs to no solid");
    result.push_back(solid);
  }
  return result;
}

namespace {

bool parted(const BlockComplex& complex, const std::vector<int>& block_solid, int block, int side) {
  const int beside = complex.blocks[block].neighbours[side];
  return beside >= 0 && block_solid[beside] != block_solid[block];
}

}  // namespace

void bound_at_interfaces(BlockComplex& complex, const PolycuboidMap& map, const std::vector<int>& block_solid) {
  std::array<int, 3> feature{-1, -1, -1};
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c)
    if (map.charts[c].sign == 0) feature[static_cast<std::size_t>(map.charts[c].axis)] = c;
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    for (int side = 0; side < 6; ++side) {
      if (!parted(complex, block_solid, b, side)) continue;
      const int chart = feature[static_cast<std::size_t>(side / 2)];
      if (chart < 0) throw StageFailed("interfaces", "the grid changes from one solid to another where there is no interface");
      for (const int k : kHexFaces[side]) complex.feature_vertices[chart].push_back(complex.blocks[b].corners[k]);
    }
  }
  for (auto& vertices : complex.feature_vertices) {
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
}

std::vector<DistanceConstraint> walls_of_solids(const BlockComplex& complex, const std::vector<int>& block_solid, const std::vector<int>& layers,
                                                const std::vector<char>& may_yield) {
  std::vector<DistanceConstraint> constraints;
  const auto ends = [&](int b, int side) { return complex.blocks[b].neighbours[side] < 0 || parted(complex, block_solid, b, side); };
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    for (int d = 0; d < 3; ++d) {
      // A line of blocks of one solid from one end to the other; those between outer charts alone the quantization knows by itself.
      if (!ends(b, low_side(d))) continue;
      int last = b;
      while (!ends(last, low_side(d) + 1)) last = complex.blocks[last].neighbours[low_side(d) + 1];
      const int low = complex.blocks[b].charts[d][0], high = complex.blocks[last].charts[d][1], least = layers[block_solid[b]];
      constraints.push_back({low, high, 1, std::numeric_limits<int>::max(), "an element through the walls of a solid"});
      if (least > 1)
        constraints.push_back({low, high, least, std::numeric_limits<int>::max(), std::to_string(least) + " elements through the walls of a solid",
                               may_yield[block_solid[b]] != 0});
    }
  }
  return constraints;
}

std::vector<Chart> charts_of_solid(const TetMesh& tets, const std::vector<int>& tet_points, const TetMesh& own, const PolycuboidMap& map,
                                   const std::vector<int>& inner_chart) {
  const int first_interface = static_cast<int>(map.charts.size()) - 1 - *std::max_element(inner_chart.begin(), inner_chart.end());
  std::map<Triangle, int> chart_at;
  for (int c = 0; c < first_interface; ++c)
    for (const int t : map.charts[c].triangles) chart_at[sorted(tets.triangles[t])] = c;
  for (std::size_t t = 0; t < tets.inner_triangles.size(); ++t) chart_at[sorted(tets.inner_triangles[t])] = first_interface + inner_chart[t];
  std::vector<Chart> charts = map.charts;
  for (Chart& chart : charts) chart.triangles.clear();
  for (int t = 0; t < static_cast<int>(own.triangles.size()); ++t) {
    Triangle triangle = own.triangles[t];
    for (int& v : triangle) v = tet_points[v];
    charts[chart_at.at(sorted(triangle))].triangles.push_back(t);
  }
  return charts;
}

SolidGrid grid_of_solid(const HexComplex& hexes, const std::vector<int>& hex_solid, int solid, const TetMesh& tets, const std::vector<int>& tet_points,
                        const PolycuboidMap& map, const std::vector<Chart>& own_charts) {
  SolidGrid grid;
  std::vector<int> index(hexes.mesh.points.size(), -1);
  std::map<Quad, std::pair<Quad, int>> faces;  // by sorted nodes: as its hex sees it, and how often
  for (int h = 0; h < static_cast<int>(hexes.mesh.hexes.size()); ++h) {
    if (hex_solid[h] != solid) continue;
    grid.hex.push_back(h);
    Hex& hex = grid.mesh.hexes.emplace_back(hexes.mesh.hexes[h]);
    for (int& n : hex) {
      if (index[n] < 0) {
        index[n] = static_cast<int>(grid.node.size());
        grid.node.push_back(n);
        grid.mesh.points.push_back(hexes.mesh.points[n]);
      }
      n = index[n];
    }
    for (const auto& f : kHexFaces) {
      const Quad quad{hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]};
      auto& face = faces[sorted(quad)];
      face.first = quad;
      ++face.second;
    }
  }
  std::map<Quad, int> outer;
  for (int q = 0; q < static_cast<int>(hexes.quads.size()); ++q) outer[sorted(hexes.quads[q])] = q;
  // Triangles by their middle in the map, per chart.
  const auto middle = [&](int t) {
    Vec3 sum = Vec3::Zero();
    for (const int v : tets.triangles[t]) sum += map.image[tet_points[v]] / 3;
    return sum;
  };
  std::vector<std::vector<std::pair<int, Vec3>>> middles(own_charts.size());
  for (std::size_t c = 0; c < own_charts.size(); ++c)
    for (const int t : own_charts[c].triangles) middles[c].emplace_back(t, middle(t));
  Vec3 low = map.image.front(), high = low;
  for (const Vec3& p : map.image) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double extent = (high - low).norm();
  for (const auto& [key, face] : faces) {
    if (face.second != 1) continue;
    Quad global = face.first;
    Vec3 centre = Vec3::Zero();
    for (int& n : global) {
      n = grid.node[n];
      centre += hexes.param[n] / 4;
    }
    const auto at = outer.find(sorted(global));
    // What is no outer quad is on an interface: charts of sign 0 with triangles, of which the plane tells too. Beside an edge the nearest triangle may be
    // beyond it.
    const auto off_plane = [&](const Chart& c) {
      double most = 0;
      for (const int n : global) most = std::max(most, std::abs(hexes.param[n][c.axis] - c.value));
      return most;
    };
    int chart = at == outer.end() ? -1 : hexes.quad_chart[at->second], triangle = -1;
    std::pair<double, double> least{std::numeric_limits<double>::infinity(), 0};
    for (std::size_t c = 0; c < own_charts.size(); ++c) {
      if (middles[c].empty() || (at == outer.end() ? own_charts[c].sign != 0 : static_cast<int>(c) != hexes.quad_chart[at->second])) continue;
      const double off = at == outer.end() ? off_plane(own_charts[c]) : 0;
      for (const auto& [t, place] : middles[c]) {
        const std::pair distance{off > kPipelineTuning.on_plane * extent ? off : 0, (place - centre).squaredNorm()};
        if (distance >= least) continue;
        least = distance;
        triangle = t;
        if (at == outer.end()) chart = static_cast<int>(c);
      }
    }
    if (triangle < 0) throw StageFailed("interfaces", "the grid changes from one solid to another where there is no interface");
    grid.quads.push_back(face.first);
    grid.quad_chart.push_back(chart);
    grid.quad_triangle.push_back(triangle);
  }
  return grid;
}

bool keeps_interfaces(const ConformalModel& model, const Association& before, const Association& after) {
  const std::vector<int> interfaces = faces_of(model);
  const auto quads_of = [&](const Association& a) {
    std::set<Quad> quads;
    for (std::size_t q = 0; q < a.quads.size(); ++q)
      if (is_interface(interfaces, a.patches[a.quad_patch[q]].front())) quads.insert(sorted(a.quads[q]));
    return quads;
  };
  const std::set<Quad> quads = quads_of(before);
  if (quads_of(after) != quads) return false;
  for (const Quad& quad : quads)
    for (const int n : quad) {
      const CadRef &was = before.point_cad[n], &is = after.point_cad[n];
      if (was.dim != is.dim || (was.dim < 2 && was.id != is.id)) return false;
    }
  return true;
}

JoinedGrids join_grids(const ConformalModel& model, const std::vector<SolidGrid>& grids, const std::vector<PaddedMesh>& solids, std::size_t nodes) {
  const std::vector<int> interfaces = faces_of(model);
  JoinedGrids joined;
  HexMesh& mesh = joined.whole.mesh;
  Association& all = joined.whole.association;
  mesh.points.assign(nodes, Vec3::Zero());
  all.point_cad.assign(nodes, {3, 1});
  std::vector<char> placed(nodes, 0);
  std::map<int, int> patch_of_interface;
  std::map<Segment, int> segment_edge;
  std::map<Quad, int> interface_quads;  // by sorted nodes: CAD face and how often it was seen, as face * 4 + count
  for (std::size_t s = 0; s < solids.size(); ++s) {
    const PaddedMesh& own = solids[s];
    const Association& a = own.association;
    std::vector<int> node = grids[s].node;
    while (node.size() < own.mesh.points.size()) {
      node.push_back(static_cast<int>(mesh.points.size()));
      mesh.points.push_back(Vec3::Zero());
      all.point_cad.push_back({3, 1});
      placed.push_back(0);
    }
    std::vector<int> patch;
    for (const std::vector<int>& faces : a.patches) {
      const auto at = std::find_if(faces.begin(), faces.end(), [&](int f) { return is_interface(interfaces, f); });
      if (at != faces.end() && faces.size() > 1) throw StageFailed("interfaces", "the mesh does not tell a common face from what is beside it", {{2, *at}});
      if (at == faces.end()) {
        patch.push_back(static_cast<int>(all.patches.size()));
        all.patches.push_back(faces);
        continue;
      }
      const auto [known, fresh] = patch_of_interface.try_emplace(*at, static_cast<int>(all.patches.size()));
      if (fresh) all.patches.push_back(faces);
      patch.push_back(known->second);
    }
    for (std::size_t p = 0; p < own.mesh.points.size(); ++p) {
      const int n = node[p];
      CadRef cad = a.point_cad[p];
      if (cad.dim == 2) cad.id = patch[cad.id];
      if (placed[n] && all.point_cad[n] != cad) {
        const CadRef& other = all.point_cad[n];
        const CadRef& one = cad.dim == 2 ? cad : other;
        if (one.dim == 2) unlike(all.patches[one.id].front());
        throw StageFailed("interfaces", "the two solids do not see their common face alike", {one.dim < 2 ? one : other});
      }
      placed[n] = 1;
      all.point_cad[n] = cad;
      mesh.points[n] = own.mesh.points[p];
    }
    joined.hex.emplace_back();
    for (Hex hex : own.mesh.hexes) {
      for (int& n : hex) n = node[n];
      joined.hex.back().push_back(static_cast<int>(mesh.hexes.size()));
      mesh.hexes.push_back(hex);
    }
    for (std::size_t q = 0; q < a.quads.size(); ++q) {
      Quad quad = a.quads[q];
      for (int& n : quad) n = node[n];
      const int face = all.patches[patch[a.quad_patch[q]]].front();
      if (is_interface(interfaces, face)) {
        const auto [known, fresh] = interface_quads.try_emplace(sorted(quad), 4 * face);
        if (known->second / 4 != face || known->second % 4 > 1) unlike(face);
        ++known->second;
        if (!fresh) continue;
      }
      all.quads.push_back(quad);
      all.quad_patch.push_back(patch[a.quad_patch[q]]);
    }
    for (std::size_t i = 0; i < a.segments.size(); ++i) {
      const Segment segment{node[a.segments[i][0]], node[a.segments[i][1]]};
      const auto [known, fresh] = segment_edge.try_emplace(sorted(segment), a.segment_edge[i]);
      if (!fresh) {
        if (known->second != a.segment_edge[i]) throw StageFailed("interfaces", "the two solids do not see their common face alike", {{1, a.segment_edge[i]}});
        continue;
      }
      all.segments.push_back(segment);
      all.segment_edge.push_back(a.segment_edge[i]);
    }
    joined.node.push_back(std::move(node));
  }
  for (const auto& [quad, seen] : interface_quads)
    if (seen % 4 != 2) unlike(seen / 4);
  return joined;
}

namespace {

/// What one solid has of a mesh.
class Part {
 public:
  Part(const CadModel& model, const PaddedMesh& whole, int solid, const std::vector<int>& hex_solid)
      : model_(model), whole_(whole), index_(whole.mesh.points.size(), -1), patch_(whole.association.patches.size(), -1) {
    for (int h = 0; h < static_cast<int>(whole.mesh.hexes.size()); ++h) {
      if (hex_solid[h] != solid) continue;
      hex.push_back(h);
      Hex& own = padded.mesh.hexes.emplace_back(whole.mesh.hexes[h]);
      for (int& n : own) n = local(n);
    }
    for (std::size_t i = 0; i < whole.association.segments.size(); ++i) add_segment(i);
    for (const int n : node) {
      CadRef cad = whole.association.point_cad[n];
      if (cad.dim == 2) cad.id = patch(cad.id);
      padded.association.point_cad.push_back(cad);
    }
  }

  void add_quad(std::size_t q, int side) {
    const Hex& of = whole_.mesh.hexes[side / 6];
    Quad& quad = padded.association.quads.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) quad[k] = index_[of[kHexFaces[side % 6][k]]];
    padded.association.quad_patch.push_back(patch(whole_.association.quad_patch[q]));
  }

  PaddedMesh padded;
  std::vector<int> node, hex;  // their numbers in the whole

 private:
  int local(int n) {
    if (index_[n] < 0) {
      index_[n] = static_cast<int>(node.size());
      node.push_back(n);
      padded.mesh.points.push_back(whole_.mesh.points[n]);
    }
    return index_[n];
  }

  int patch(int p) {
    if (patch_[p] < 0) {
      patch_[p] = static_cast<int>(padded.association.patches.size());
      padded.association.patches.push_back(whole_.association.patches[p]);
    }
    return patch_[p];
  }

  void add_segment(std::size_t i) {
    const auto [from, to] = whole_.association.segments[i];
    const int edge = whole_.association.segment_edge[i];
    if (index_[from] < 0 || index_[to] < 0 || !std::binary_search(model_.edges().begin(), model_.edges().end(), edge)) return;
    padded.association.segments.push_back({index_[from], index_[to]});
    padded.association.segment_edge.push_back(edge);
  }

  const CadModel& model_;
  const PaddedMesh& whole_;
  std::vector<int> index_, patch_;
};

}  // namespace

PaddedGrids part_grids(const ConformalModel& model, PaddedMesh whole, const std::vector<int>& hex_solid, const std::vector<PaddedMesh>& before,
                       const Monitor& monitor) {
  std::vector<Part> parts;
  for (std::size_t s = 0; s < model.solids.size(); ++s) {
    monitor.check();
    parts.emplace_back(model.solids[s], whole, static_cast<int>(s), hex_solid);
  }
  const std::vector<Quad>& quads = whole.association.quads;
  const HexTopology topology = build_topology(whole.mesh, quads);
  for (std::size_t q = 0; q < quads.size(); ++q)
    for (const int side : sides_at(whole.mesh, topology, quads[q])) parts[static_cast<std::size_t>(hex_solid[side / 6])].add_quad(q, side);
  PaddedGrids result;
  for (std::size_t s = 0; s < parts.size(); ++s) {
    Association& a = parts[s].padded.association;
    const Association& was = before[s].association;
    a.lost_edges = was.lost_edges;
    a.lost_vertices = was.lost_vertices;
    a.ignored_edges = was.ignored_edges;
    a.ignored_vertices = was.ignored_vertices;
    a.ignored_faces = was.ignored_faces;
    result.solids.push_back(std::move(parts[s].padded));
    result.joined.node.push_back(std::move(parts[s].node));
    result.joined.hex.push_back(std::move(parts[s].hex));
  }
  result.joined.whole = std::move(whole);
  return result;
}

}  // namespace polycube
