#include "pipeline/local_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/hexahedron.h"
#include "core/options.h"
#include "pipeline/shortfalls.h"
#include "pipeline/tuning.h"
#include "refine/refine.h"

namespace polycube {
namespace {

int most_levels(const RefinePlan& plan) {
  int most = 0;
  for (const auto* list : {&plan.everywhere, &plan.round}) {
    for (const LocalRefinement& r : *list) most = std::max(most, r.levels);
  }
  return most;
}

/// A mesh on the way, with the cells that its cells were parts of before all levels.
struct Level {
  const HexMesh& mesh;
  const Association& association;
  const std::vector<int>& parent;
};

/// Cells at an entity as the user knows it.
std::vector<char> cells_at(const Level& now, const RefinePlan& plan, const CadRef& entity) {
  if (entity.dim == 3 && !plan.hex_solid.empty()) {
    std::vector<char> cells;
    for (const int parent : now.parent) cells.push_back(plan.hex_solid[parent] == entity.id);
    return cells;
  }
  const auto pieces = plan.pieces.find(entity);
  if (pieces == plan.pieces.end()) return cells_at(now.mesh, now.association, entity);
  std::vector<char> cells(now.mesh.hexes.size(), 0);
  for (const CadRef& piece : pieces->second) {
    const std::vector<char> at = cells_at(now.mesh, now.association, piece);
    for (std::size_t h = 0; h < cells.size(); ++h) cells[h] |= at[h];
  }
  return cells;
}

std::vector<int> counted(std::size_t n) {
  std::vector<int> numbers(n);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// The cells that the last level makes of those at the entities alone: the least that comes of it.
void check_levels(const Level& now, const RefinePlan& plan) {
  for (const LocalRefinement& r : plan.everywhere) {
    const std::vector<char> cells = cells_at(now, plan, r.entity);
    check_count(static_cast<double>(std::count(cells.begin(), cells.end(), 1)) * std::pow(3.0, r.entity.dim * (r.levels - 1)) * 27);
  }
}

/// The cells that level `level` (from 1) divides. Where another level follows, also those around them, so that its templates are among cells of even size.
std::vector<char> cells_of(const Level& now, const RefinePlan& plan, const LocalRefinements& refinements, int level) {
  std::vector<char> result(now.mesh.hexes.size(), 0);
  for (const LocalRefinement& r : refinements) {
    if (r.levels < level) continue;
    std::vector<char> cells = cells_at(now, plan, r.entity);
    if (r.levels > level) cells = with_neighbours(now.mesh, cells);
    for (std::size_t h = 0; h < cells.size(); ++h) result[h] |= cells[h];
  }
  return result;
}

/// Mesh edges that leave a CAD face into the cells on it.
std::vector<Segment> edges_from(const HexMesh& mesh, const Association& association, int face) {
  std::vector<char> on_face(mesh.points.size(), 0);
  for (std::size_t q = 0; q < association.quads.size(); ++q) {
    const auto& patch = association.patches[association.quad_patch[q]];
    if (!std::binary_search(patch.begin(), patch.end(), face)) continue;
    for (const int node : association.quads[q]) on_face[node] = 1;
  }
  const std::vector<char> cells = cells_at(mesh, association, {2, face});
  std::vector<Segment> edges;
  for (std::size_t h = 0; h < cells.size(); ++h) {
    for (const auto& [c, d] : kHexEdges) {
      const int a = mesh.hexes[h][c], b = mesh.hexes[h][d];
      if (cells[h] && on_face[a] != on_face[b]) edges.push_back({a, b});
    }
  }
  return edges;
}

RefineRegion region_of(const Level& now, const RefinePlan& plan, int level) {
  const auto& [mesh, association, parent] = now;
  RefineRegion region{cells_of(now, plan, plan.everywhere, level), {}};
  if (plan.round.empty()) return region;
  for (std::size_t h = 0; h < region.cells.size(); ++h) {
    if (!region.cells[h]) continue;
    for (const auto& [c, d] : kHexEdges) region.along.push_back({mesh.hexes[h][c], mesh.hexes[h][d]});
  }
  for (std::size_t s = 0; s < association.segments.size(); ++s) {
    if (std::find(plan.edges.begin(), plan.edges.end(), association.segment_edge[s]) != plan.edges.end()) region.along.push_back(association.segments[s]);
  }
  for (const LocalRefinement& r : plan.round) {
    if (r.levels < level) continue;
    const std::vector<Segment> out = edges_from(mesh, association, r.entity.id);
    region.along.insert(region.along.end(), out.begin(), out.end());
  }
  const std::vector<char> round = cells_of(now, plan, plan.round, level);
  for (std::size_t h = 0; h < round.size(); ++h) region.cells[h] |= round[h];
  return region;
}

}  // namespace

RefinePlan plan_for_bores(const std::vector<RoundEdge>& edges, const EdgeLevels& levels, const Association& association, int edge_count) {
  const std::vector<int> elements = elements_on_edges(association, edge_count);
  std::map<int, int> round;  // per circle: elements
  for (const RoundEdge& r : edges) {
    if (r.circle > 0) round[r.circle] += elements[r.edge];
  }
  RefinePlan plan;
  std::map<int, int> bores;
  for (const RoundEdge& r : edges) {
    if (!levels.contains(r.edge) || elements[r.edge] == 0) continue;
    int level = 0;
    for (int count = round.at(r.circle); count < r.round; count *= 3) ++level;
    if (level == 0) continue;
    bores[r.bore] = std::max(bores[r.bore], level);
    plan.edges.push_back(r.edge);
  }
  for (const auto& [face, level] : bores) plan.round.push_back({{2, face}, level});
  return plan;
}

std::size_t count_refined(const HexMesh& mesh, const Association& association, const RefinePlan& plan, int levels, const Monitor& monitor) {
  RefinedMesh refined{mesh, association, counted(mesh.hexes.size()), 0};
  for (int level = 1; level <= std::min(levels, most_levels(plan)); ++level) {
    std::vector<int> before = std::move(refined.parent);
    refined = refine_cells(refined.mesh, refined.association, region_of({refined.mesh, refined.association, before}, plan, level), monitor);
    for (int& parent : refined.parent) parent = before[parent];
  }
  return refined.mesh.hexes.size();
}

LocallyRefined refine_locally(const CadModel& model, const PaddedMesh& padded, const RefinePlan& plan, const FitOptions& options, const Monitor& monitor) {
  const std::vector<int> themselves = counted(padded.mesh.hexes.size());
  const Level first{padded.mesh, padded.association, themselves};
  check_levels(first, plan);
  LocallyRefined result{padded, {}, themselves, {}};
  FitOptions keeping = options;
  keeping.keep_sizes = true;
  for (int level = 1; level <= most_levels(plan); ++level) {
    const std::size_t before = result.padded.mesh.hexes.size();
    const RefineRegion region = region_of({result.padded.mesh, result.padded.association, result.parent}, plan, level);
    RefinedMesh refined = refine_cells(result.padded.mesh, result.padded.association, region, monitor);
    const auto asked = static_cast<double>(std::count(region.cells.begin(), region.cells.end(), 1));
    const bool spreads = refined.grown > kPipelineTuning.much_of_asked * asked && refined.grown > kPipelineTuning.much_of_all * static_cast<double>(before);
    if (spreads && result.warnings.empty())
      result.warnings.push_back("local refinement: " + std::to_string(refined.grown) + " cells are divided besides the " + std::to_string(std::lround(asked)) +
                                " asked for, since only convex regions have templates round them");
    result.padded.mesh = std::move(refined.mesh);
    result.padded.association = std::move(refined.association);
    for (int& parent : refined.parent) parent = result.parent[parent];
    result.parent = std::move(refined.parent);
    result.fitted = fit(model, result.padded.mesh, result.padded.association, keeping, monitor);
    monitor.log("refine: level " + std::to_string(level) + ", " + std::to_string(before) + " cells to " + std::to_string(result.padded.mesh.hexes.size()) +
                ", min SJ " + std::to_string(result.fitted.min_scaled_jacobian) + ", mean " + std::to_string(result.fitted.mean_scaled_jacobian) + ", " +
                std::to_string(result.fitted.inverted) + " inverted");
    if (result.fitted.inverted > 0) break;
  }
  for (const LocalRefinement& r : plan.everywhere) {
    const std::vector<char> cells = cells_at(first, plan, r.entity);
    if (std::find(cells.begin(), cells.end(), 1) == cells.end())
      result.warnings.push_back("local refinement: " + text_of(r) + " has no cells, as the mesh does not follow it");
  }
  return result;
}

}  // namespace polycube
