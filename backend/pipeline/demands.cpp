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

SideFaces find_side_faces(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& complex) {
  std::map<Triangle, int> triangle_at;
  for (int t = 0; t < static_cast<int>(tets.triangles.size()); ++t) triangle_at[sorted(tets.triangles[t])] = t;
  std::vector<int> chart_of(tets.triangles.size(), -1);
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int t : map.charts[c].triangles) chart_of[t] = c;
  }
  SideFaces result(complex.blocks.size());
  for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
    const Block& block = complex.blocks[b];
    for (int tet : block.tets) {
      for (int k = 0; k < 4; ++k) {
        Triangle facet;
        for (int i = 0, n = 0; i < 4; ++i) {
          if (i != k) facet[n++] = tets.tets[tet][i];
        }
        const auto at = triangle_at.find(sorted(facet));
        if (at == triangle_at.end()) continue;
        const auto side = std::find(block.side_chart.begin(), block.side_chart.end(), chart_of[at->second]) - block.side_chart.begin();
        if (side == 6) continue;
        // A tet that only reaches into the block has its triangle elsewhere.
        const Vec3 centre = (map.image[facet[0]] + map.image[facet[1]] + map.image[facet[2]]) / 3;
        bool inside = true;
        for (int d = 0; d < 3; ++d) {
          if (d == side / 2) continue;
          inside &= centre[d] >= map.charts[block.charts[d][0]].value && centre[d] <= map.charts[block.charts[d][1]].value;
        }
        if (inside) result[b][static_cast<std::size_t>(side)].push_back(tets.triangle_face[at->second]);
      }
    }
    for (auto& faces : result[b]) {
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    }
  }
  return result;
}

DistanceConstraint constraint(const PolycuboidMap& map, int a, int b, int at_least, int at_most, const std::string& name) {
  if (map.charts[a].value > map.charts[b].value) std::swap(a, b);
  return {a, b, at_least, at_most, name};
}

void divide_wall(const Division& division, const SideFaces& side_faces, const PolycuboidMap& map, const BlockComplex& complex,
                 std::vector<DistanceConstraint>& constraints) {
  std::set<std::array<int, 2>> pairs;
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    for (int d = 0; d < 3; ++d) {
      if (complex.blocks[b].neighbours[2 * d] >= 0) continue;
      int last = b;
      while (complex.blocks[last].neighbours[2 * d + 1] >= 0) last = complex.blocks[last].neighbours[2 * d + 1];
      const auto has = [&](int block, int side, int face) {
        const auto& faces = side_faces[block][side];
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

QuantizeOptions quantize_options(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const MeshOptions& options,
                                 double scale) {
  QuantizeOptions result;
  result.scale = scale;
  result.min_layers = std::max(1, options.min_layers);
  if (options.divisions.empty() && options.sizes.empty()) return result;
  const SideFaces side_faces = find_side_faces(tets, map, blocks);
  const auto chains = edge_chains(model, tets);
  const EdgeRuns runs(tets, map, blocks);
  for (const Division& d : options.divisions) {
    if (d.edge > 0) {
      divide_edge(d, runs.of(chains[d.edge]), map, result.constraints);
    } else {
      divide_wall(d, side_faces, map, blocks, result.constraints);
    }
  }
  for (const LocalSize& s : options.sizes) {
    if (s.face == 0) {
      result.axis_scale[s.axis] = 1 / (s.size * scale);
      continue;
    }
    result.block_scale.resize(blocks.blocks.size(), 1);
    for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
      const auto on_face = [&](const std::vector<int>& faces) { return std::binary_search(faces.begin(), faces.end(), s.face); };
      // Of several faces the finest size wins.
      if (std::any_of(side_faces[b].begin(), side_faces[b].end(), on_face)) {
        double& factor = result.block_scale[b];
        factor = factor == 1 ? 1 / (s.size * scale) : std::max(factor, 1 / (s.size * scale));
      }
    }
  }
  return result;
}

void bias_edges(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const EdgeBiases& biases,
                const std::vector<int>& value, Spacing& spacing) {
  if (biases.empty()) return;
  const auto chains = edge_chains(model, tets);
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
