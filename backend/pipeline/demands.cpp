#include "pipeline/demands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/sorted.h"
#include "label/features.h"
#include "pipeline/edge_runs.h"

namespace polycube {
namespace {

/// Per block and side the CAD faces there, ascending.
using SideFaces = std::vector<std::array<std::vector<int>, 6>>;

/// The side of a block that a chart lies on, 6 for none: an outer chart, or one between two solids, which has the number of its plane only.
std::size_t side_on(const BlockComplex& complex, const std::vector<int>& block_solid, int b, const Chart& chart, int c) {
  const Block& block = complex.blocks[b];
  const auto outer = std::find(block.side_chart.begin(), block.side_chart.end(), c);
  if (outer != block.side_chart.end()) return static_cast<std::size_t>(outer - block.side_chart.begin());
  for (const int end : {0, 1}) {
    const int side = 2 * chart.axis + end;
    if (chart.sign == 0 && block.neighbours[side] >= 0 && is_wall(complex, block_solid, b, side) &&
        block.charts[static_cast<std::size_t>(chart.axis)][static_cast<std::size_t>(end)] == complex.unknown[c])
      return static_cast<std::size_t>(side);
  }
  return 6;
}

DistanceConstraint constraint(const PolycuboidMap& map, int a, int b, int at_least, int at_most, const std::string& name) {
  if (map.charts[a].value > map.charts[b].value) std::swap(a, b);
  return {a, b, at_least, at_most, name};
}

void divide_wall(const Division& division, const DemandPlaces& places, const PolycuboidMap& map, const BlockComplex& complex,
                 std::vector<DistanceConstraint>& constraints) {
  std::set<std::array<int, 2>> pairs;
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    for (int d = 0; d < 3; ++d) {
      if (!is_wall(complex, places.block_solid, b, 2 * d)) continue;
      int last = b;
      while (!is_wall(complex, places.block_solid, last, 2 * d + 1)) last = complex.blocks[last].neighbours[2 * d + 1];
      const auto has = [&](int block, int side, int face) {
        const auto& faces = places.side_faces[block][side];
        return std::binary_search(faces.begin(), faces.end(), face);
      };
      const auto [one, other] = division.faces;
      if ((has(b, 2 * d, one) && has(last, 2 * d + 1, other)) || (has(b, 2 * d, other) && has(last, 2 * d + 1, one))) {
        pairs.insert({complex.blocks[b].charts[d][0], complex.blocks[last].charts[d][1]});
      }
    }
  }
  if (pairs.empty()) {
    throw StageFailed("quantize", "the faces of division " + text_of(division) + " are nowhere opposite each other",
                      {{2, division.faces[0]}, {2, division.faces[1]}});
  }
  for (const auto& [low, high] : pairs) {
    constraints.push_back(constraint(map, low, high, division.at_least, division.at_most, text_of(division)));
  }
}

void divide_edge(const Division& division, const std::vector<EdgeRun>& runs, const PolycuboidMap& map, std::vector<DistanceConstraint>& constraints) {
  const int count = static_cast<int>(runs.size());
  if (count == 0 || std::any_of(runs.begin(), runs.end(), [](const EdgeRun& r) { return r.from < 0 || r.to < 0; })) {
    throw StageFailed("quantize", "the grid does not follow the edge of division " + text_of(division), {{1, division.edge}});
  }
  if (division.at_most < count) {
    throw StageFailed("quantize",
                      "division " + text_of(division) + ": the edge takes " + std::to_string(count) + " turns of the grid, it needs as many elements",
                      {{1, division.edge}});
  }
  double whole = 0;
  for (const EdgeRun& run : runs) whole += run.length;
  // Both numbers are shared out by length; one element for every run at least.
  double passed = 0;
  int least_before = 0, most_before = 0;
  for (int i = 0; i < count; ++i) {
    passed += runs[i].length;
    const auto share = [&](int all, int before) {
      const int end = static_cast<int>(std::lround(all * passed / whole));
      return std::clamp(end, before + 1, std::max(before + 1, all - (count - 1 - i)));
    };
    const int least = share(division.at_least, least_before);
    const bool bounded = division.at_most != Division::kNoMaximum;
    const int most = bounded ? share(division.at_most, most_before) : 0;
    const int at_least = std::min(least - least_before, bounded ? most - most_before : least - least_before);
    constraints.push_back(constraint(map, runs[i].from, runs[i].to, at_least, bounded ? most - most_before : Division::kNoMaximum, text_of(division)));
    least_before = least;
    most_before = most;
  }
}

/// Elements that a division got.
struct Found {
  int least = 0, most = 0;  ///< both 0 where there are none
  bool meets(const Division& d) const { return least >= d.at_least && most <= d.at_most; }
};

std::vector<Found> find_divisions(const HexMesh& mesh, const Association& association, const Divisions& divisions) {
  // Columns of cells from boundary quad to boundary quad.
  std::map<std::array<int, 4>, std::vector<std::array<int, 2>>> cells;  // hex, side
  std::map<std::array<int, 4>, int> quad_at;
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h) {
    for (int side = 0; side < 6; ++side) {
      std::array<int, 4> face;
      for (int k = 0; k < 4; ++k) face[k] = mesh.hexes[h][kHexFaces[side][k]];
      cells[sorted(face)].push_back({h, side});
    }
  }
  for (int q = 0; q < static_cast<int>(association.quads.size()); ++q) quad_at[sorted(association.quads[q])] = q;
  const auto on = [&](int quad, int face) {
    const auto& faces = association.patches[association.quad_patch[quad]];
    return std::binary_search(faces.begin(), faces.end(), face);
  };
  std::vector<Found> result;
  for (const Division& d : divisions) {
    Found& found = result.emplace_back();
    if (d.edge > 0) {
      found.least = found.most = static_cast<int>(std::count(association.segment_edge.begin(), association.segment_edge.end(), d.edge));
      continue;
    }
    for (int q = 0; q < static_cast<int>(association.quads.size()); ++q) {
      if (!on(q, d.faces[0])) continue;
      auto key = sorted(association.quads[q]);
      int length = 0, hex = -1;
      for (;;) {
        const auto& behind = cells.at(key);
        const auto next = std::find_if(behind.begin(), behind.end(), [&](const auto& cell) { return cell[0] != hex; });
        if (next == behind.end() || length > static_cast<int>(mesh.hexes.size())) break;
        hex = (*next)[0];
        ++length;
        std::array<int, 4> face;
        for (int k = 0; k < 4; ++k) face[k] = mesh.hexes[hex][kHexFaces[(*next)[1] ^ 1][k]];
        key = sorted(face);
      }
      const auto end = quad_at.find(key);
      if (end == quad_at.end() || !on(end->second, d.faces[1])) continue;
      found.least = found.most == 0 ? length : std::min(found.least, length);
      found.most = std::max(found.most, length);
    }
  }
  return result;
}

}  // namespace

void check_divisions(const CadModel& model, const Divisions& divisions) {
  for (const Division& d : divisions) {
    const std::string start = "--divisions: " + text_of(d) + ": ";
    if (d.edge > 0 && model.edge(d.edge).seam) throw InvalidInput(start + "the edge is a seam, which meshes do not follow");
    if (d.edge > 0 && (model.edge(d.edge).degenerate || model.edge(d.edge).tiny)) throw InvalidInput(start + "the edge is a point");
    if (d.edge == 0 && d.faces[0] == d.faces[1]) throw InvalidInput(start + "both faces are the same");
  }
}

void check_biases(const CadModel& model, const EdgeBiases& biases) {
  for (const EdgeBias& b : biases) {
    const std::string start = "--bias: " + text_of(b) + ": ";
    if (model.edge(b.edge).seam) throw InvalidInput(start + "the edge is a seam, which meshes do not follow");
    if (model.edge(b.edge).degenerate || model.edge(b.edge).tiny) throw InvalidInput(start + "the edge is a point");
  }
}

void check_refinements(const CadModel& model, const LocalRefinements& refinements) {
  for (const LocalRefinement& r : refinements) {
    if (r.entity.dim != 1) continue;
    const std::string start = "--refine: " + text_of(r) + ": ";
    if (model.edge(r.entity.id).seam) throw InvalidInput(start + "the edge is a seam, which meshes do not follow");
    if (model.edge(r.entity.id).degenerate || model.edge(r.entity.id).tiny) throw InvalidInput(start + "the edge is a point");
  }
}

bool is_wall(const BlockComplex& blocks, const std::vector<int>& block_solid, int block, int side) {
  const int beside = blocks.blocks[block].neighbours[side];
  return beside < 0 || (!block_solid.empty() && block_solid[beside] != block_solid[block]);
}

SideFaces find_side_faces(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& complex, const std::vector<int>& block_solid,
                          const TriangleChart& chart_at) {
  SideFaces result(complex.blocks.size());
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    const Block& block = complex.blocks[b];
    for (int tet : block.tets) {
      if (!block_solid.empty() && tets.tet_solid[tet] != block_solid[b]) continue;
      for (int k = 0; k < 4; ++k) {
        Triangle facet;
        for (int i = 0, n = 0; i < 4; ++i) {
          if (i != k) facet[n++] = tets.tets[tet][i];
        }
        const auto at = chart_at(sorted(facet), static_cast<int>(b));
        if (!at) continue;
        const std::size_t side = side_on(complex, block_solid, static_cast<int>(b), map.charts[at->first], at->first);
        if (side == 6) continue;
        // A tet that only reaches into the block has its triangle elsewhere.
        const Vec3 centre = (map.image[facet[0]] + map.image[facet[1]] + map.image[facet[2]]) / 3;
        bool inside = true;
        for (int d = 0; d < 3; ++d) {
          if (d == static_cast<int>(side) / 2) continue;
          inside &= centre[d] >= map.charts[block.charts[d][0]].value && centre[d] <= map.charts[block.charts[d][1]].value;
        }
        if (inside) result[b][side].push_back(at->second);
      }
    }
    for (auto& faces : result[b]) {
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
  }
  return result;
}

DemandPlaces find_places(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks) {
  std::map<Triangle, int> triangle_at;
  for (int t = 0; t < static_cast<int>(tets.triangles.size()); ++t) triangle_at[sorted(tets.triangles[t])] = t;
  std::vector<int> chart_of(tets.triangles.size(), -1);
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int t : map.charts[c].triangles) chart_of[t] = c;
  }
  const auto chart_at = [&](const Triangle& triangle, int) -> std::optional<std::pair<int, int>> {
    const auto at = triangle_at.find(triangle);
    if (at == triangle_at.end() || chart_of[at->second] < 0) return std::nullopt;
    return std::pair(chart_of[at->second], tets.triangle_face[at->second]);
  };
  return {find_side_faces(tets, map, blocks, {}, chart_at), edge_chains(model, tets), {}, {}};
}

QuantizeOptions quantize_options(const DemandPlaces& places, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                 const MeshOptions& options, double scale) {
  QuantizeOptions result;
  result.scale = scale;
  result.min_layers = std::max(1, options.min_layers);
  std::vector<double> block_size = places.block_size;
  block_size.resize(blocks.blocks.size(), 0);
  const EdgeRuns runs(tets, map, blocks);
  for (const Division& d : options.divisions) {
    if (d.edge > 0) {
      divide_edge(d, runs.of(places.edge_chains[d.edge]), map, result.constraints);
    } else {
      divide_wall(d, places, map, blocks, result.constraints);
    }
  }
  std::vector<double> face_size(blocks.blocks.size(), 0);
  for (const LocalSize& s : options.sizes) {
    if (s.face == 0) {
      result.axis_scale[s.axis] = 1 / (s.size * scale);
      continue;
    }
    for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
      const auto on_face = [&](const std::vector<int>& faces) { return std::binary_search(faces.begin(), faces.end(), s.face); };
      if (std::none_of(places.side_faces[b].begin(), places.side_faces[b].end(), on_face)) continue;
      // Of several faces the finest size wins.
      face_size[b] = face_size[b] == 0 ? s.size : std::min(face_size[b], s.size);
    }
  }
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    const double size = face_size[b] > 0 ? face_size[b] : block_size[b];
    if (size == 0) continue;
    result.block_scale.resize(blocks.blocks.size(), 1);
    result.block_scale[b] = 1 / (size * scale);
  }
  return result;
}

void bias_edges(const std::vector<std::vector<int>>& chains, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                const EdgeBiases& biases, const std::vector<int>& value, Spacing& spacing) {
  const EdgeRuns edge_runs(tets, map, blocks);
  for (const EdgeBias& b : biases) {
    const std::vector<EdgeRun> runs = edge_runs.of(chains[b.edge]);
    int cells = 0;
    for (const EdgeRun& run : runs) {
      if (run.from < 0 || run.to < 0) throw StageFailed("quantize", "the grid does not follow the edge of --bias " + text_of(b), {{1, b.edge}});
      cells += std::abs(value[run.to] - value[run.from]);
    }
    if (cells < 2) continue;
    for (const EdgeRun& run : runs) bias(value, run.from, run.to, std::pow(b.ratio, 1.0 / (cells - 1)), spacing);
  }
}

Divisions allow_for_padding(const HexMesh& mesh, const Association& association, const Divisions& divisions) {
  Divisions fewer = divisions;
  if (divisions.empty()) return fewer;
  const std::vector<Found> found = find_divisions(mesh, association, divisions);
  for (std::size_t i = 0; i < fewer.size(); ++i) {
    const int surplus = found[i].most - divisions[i].at_most;
    if (surplus <= 0 || divisions[i].at_most - surplus < 1) continue;
    fewer[i].at_most -= surplus;
    fewer[i].at_least = std::max(1, fewer[i].at_least - surplus);
  }
  return fewer;
}

std::vector<std::string> unmet_divisions(const HexMesh& mesh, const Association& association, const Divisions& divisions) {
  std::vector<std::string> lines;
  if (divisions.empty()) return lines;
  const std::vector<Found> found = find_divisions(mesh, association, divisions);
  for (std::size_t i = 0; i < divisions.size(); ++i) {
    if (found[i].meets(divisions[i])) continue;
    const std::string most = found[i].most == found[i].least ? "" : " to " + std::to_string(found[i].most);
    lines.push_back("division " + text_of(divisions[i]) + ": the mesh has " + std::to_string(found[i].least) + most + " elements there");
  }
  return lines;
}

}  // namespace polycube
