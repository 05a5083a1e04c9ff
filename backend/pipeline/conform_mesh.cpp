#include "pipeline/conform_mesh.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "fem/conform.h"
#include "fit/fit.h"
#include "pad/associate.h"
#include "pipeline/block_ids.h"
#include "pipeline/bounds.h"
#include "pipeline/conform_demands.h"
#include "pipeline/conform_grid.h"
#include "pipeline/conform_pad.h"
#include "pipeline/gate.h"
#include "pipeline/integers.h"
#include "pipeline/local_refinement.h"
#include "pipeline/loose_nodes.h"
#include "pipeline/search/tuning.h"
#include "pipeline/shortfalls.h"
#include "pipeline/solids.h"
#include "pipeline/stage_clock.h"
#include "pipeline/structures.h"
#include "pipeline/tuning.h"
#include "pipeline/vertex_room.h"
#include "tet/classify.h"
#include "tet/tet.h"

namespace polycube {
namespace {

double size_of(const MeshOptions& options, const Assembly& assembly) {
  return options.hexes > 0 ? std::cbrt(assembly.volume() / options.hexes) : effective_size(options, assembly.diagonal());
}

double typical_edge(const HexMesh& mesh) {
  double sum = 0;
  for (const Hex& h : mesh.hexes)
    sum += (mesh.points[h[0]] - mesh.points[h[1]]).norm() + (mesh.points[h[0]] - mesh.points[h[3]]).norm() + (mesh.points[h[0]] - mesh.points[h[4]]).norm();
  return sum / (3.0 * static_cast<double>(mesh.hexes.size()));
}

/// A structure with what is asked of the mesh on it.
struct Base {
  const ConformalStructure& s;
  std::vector<DistanceConstraint> walls{};
  DemandPlaces places{};
};

/// Per joined edge at an interface: nodes of the grid that stand for it, from its first to its second vertex.
using InterfacePaths = std::map<int, std::vector<int>>;

/// A solid's part of the grid, and ways to pad it.
struct SolidChoice {
  SolidGrid grid;
  std::vector<PaddedMesh> padded;
  std::vector<int> added_hexes;
};
using SolidChoices = std::vector<SolidChoice>;

struct Draft {
  JoinedGrids joined;
  std::vector<PaddedMesh> solids;  ///< padded, each by its own numbers
  std::vector<int> hex_block;      ///< per hex of the whole
  FitReport fitted;
  std::vector<int> padded_hexes;      ///< per solid
  std::vector<PaddedMesh> unrefined;  ///< where cells were refined locally: the solids before
  std::vector<std::string> refine_warnings;
  Quantization quantization;
  int charts = 0, blocks = 0;
  double grid_hexes = 0;  ///< before padding
  double finer = 1;       ///< than asked for
  int lost() const {
    int sum = 0;
    for (const PaddedMesh& s : solids) sum += static_cast<int>(s.association.lost_edges.size());
    return sum;
  }
  /// With the cells of the grid and its layers alone.
  const std::vector<PaddedMesh>& before_refining() const { return unrefined.empty() ? solids : unrefined; }
};

class Conformer {
 public:
  /// `options`: of the joined solids.
  Conformer(const ConformalModel& model, const Assembly& assembly, const MeshOptions& options, ConformalStructures& structures, StageClock& clock,
            const Monitor& monitor)
      : model_(model), assembly_(assembly), options_(options), structures_(structures), clock_(clock), monitor_(monitor), size_(size_of(options, assembly)) {}

  ConformalMesh run() {
    std::optional<Draft> best;
    std::optional<StageFailed> failure;
    int tried = 0, first = -1;
    for (int i = 0; i < kPipelineTuning.conform_labellings + static_cast<int>(kSearchTuning.finer.size()); ++i) {
      const bool finer = i >= kPipelineTuning.conform_labellings;
      if (finer && (best || first < 0 || options_.coarsest)) break;
      const ConformalStructure* structure = nullptr;
      try {
        ++tried;
        structure = structures_.structure(finer ? first : i, clock_, monitor_);
        if (!structure) continue;
        if (first < 0) first = i;
        finer_ = finer ? kSearchTuning.finer[static_cast<std::size_t>(i - kPipelineTuning.conform_labellings)] : 1;
        if (finer) monitor_.log("conform: on a grid that is finer");
        Draft draft = drafted(based(*structure));
        const auto rank = [](const Draft& d) { return std::pair(-d.lost(), d.fitted.min_scaled_jacobian); };
        if (!best || rank(draft) > rank(*best)) best = std::move(draft);
        if (best->lost() == 0 && best->fitted.min_scaled_jacobian >= kSearchTuning.good_scaled_jacobian) break;
      } catch (const StageFailed& e) {
        monitor_.log("conform: " + e.stage() + ": " + e.what());
        if (!failure || e.stage() == "interfaces") failure = structure ? with_folds(e, *structure) : e;
      } catch (const OutOfTime&) {
        if (!best) throw;
        out_of_time_ = true;
        break;
      }
    }
    if (!best) throw *failure;
    return finished(*best, tried);
  }

  /// A failure that names nothing, with the CAD faces where the map folds.
  static StageFailed with_folds(const StageFailed& failure, const ConformalStructure& structure) {
    if (!failure.entities().empty() || structure.folded_faces.empty()) return failure;
    std::vector<CadRef> faces;
    for (const int f : structure.folded_faces) faces.push_back({2, f});
    return StageFailed(failure.stage(), std::string(failure.what()) + ": the map folds", faces);
  }

  /// Hexahedra of the mesh, without fitting them: those of the first labelling that comes to a grid.
  int count() {
    std::optional<StageFailed> failure;
    for (int i = 0; i < kPipelineTuning.conform_labellings; ++i) {
      try {
        if (const ConformalStructure* structure = structures_.structure(i, clock_, monitor_)) return count(based(*structure));
      } catch (const StageFailed& e) {
        if (!failure) failure = e;
      }
    }
    throw StageFailed(*failure);
  }

 private:
  int count(const Base& base) {
    int cells = 0;
    double share = 1;
    for (int round = 0; round <= kSearchTuning.recounts; ++round) {
      Laid made = laid(base, options_.divisions, share);
      const std::size_t first =
          made.choices.size() < 2 ? 0 : clock_.stage("fit", [&] { return most_promising(model_.whole, candidates_of(made.choices), fit_options(), monitor_); });
      const JoinedGrids& joined = made.choices[first].joined;
      const auto found = static_cast<int>(count_refined(joined.whole.mesh, joined.whole.association, places_of(joined), kAllLevels, monitor_));
      const auto miss = [&](int n) { return std::abs(n / wanted_cells() - 1); };
      if (round > 0 && miss(found) >= miss(cells)) break;
      cells = found;
      if (options_.hexes <= 0 || miss(cells) <= kSearchTuning.padded_miss) break;
      share = made.draft.grid_hexes / cells;
    }
    return cells;
  }

  /// What is asked of a solid, by its number in the assembly.
  MeshOptions of_solid(std::size_t s) const {
    MeshOptions own = options_;
    std::erase_if(own.sizes, [&](const LocalSize& l) { return l.solid != model_.numbers[s]; });
    std::erase_if(own.divisions, [&](const Division& d) { return d.solid != model_.numbers[s]; });
    own.size = 0;
    return without_solids(own);
  }

  /// With cells through the walls of each solid, and places with the sizes of the solids.
  Base based(const ConformalStructure& structure) const {
    Base base{structure};
    std::vector<int> layers;
    std::vector<char> may_yield;
    std::vector<double> size;
    for (std::size_t s = 0; s < model_.solids.size(); ++s) {
      const MeshOptions own = of_solid(s);
      layers.push_back(effective_min_layers(own));
      may_yield.push_back(own.min_layers == 0);
      size.push_back(options_.coarsest ? 0 : own.size);
    }
    base.walls = walls_of_solids(structure.blocks, structure.block_solid, layers, may_yield);
    base.places = find_places(model_, assembly_, structure.tets, structure.map, structure.blocks, structure.block_solid, structure.between.chart);
    for (const int s : structure.block_solid) base.places.block_size.push_back(size[static_cast<std::size_t>(s)]);
    return base;
  }

  /// Demands on single faces and edges alone.
  MeshOptions by_entity(const Divisions& divisions) const {
    MeshOptions own = options_;
    own.divisions = divisions;
    own.min_layers = 0;
    std::erase_if(own.divisions, [](const Division& d) { return d.solid > 0; });
    std::erase_if(own.sizes, [](const LocalSize& l) { return l.solid > 0; });
    return own;
  }

  Draft drafted(const Base& base) {
    Draft draft = gridded(base, options_.divisions, 1);
    if (options_.hexes > 0) recount(base, draft);
    retry_padded(base, draft);
    return draft;
  }

  /// Another try is a gain where it works out at all.
  std::optional<Draft> again(const Base& base, const Divisions& divisions, double share, const std::string& how) {
    try {
      return gridded(base, divisions, share);
    } catch (const StageFailed& e) {
      monitor_.log("conform: with " + how + ": " + e.stage() + ": " + e.what());
    } catch (const InvalidInput& e) {
      monitor_.log("conform: with " + how + ": " + e.what());
    }
    return std::nullopt;
  }

  double wanted_cells() const {
    double volume = 0;
    for (const CadModel& solid : model_.solids) volume += solid.volume();
    return options_.hexes * volume / assembly_.volume();
  }

  /// Where padding takes the number of cells away from the one asked for, a grid with its share of them.
  void recount(const Base& base, Draft& draft) {
    const auto cells = [](const Draft& d) { return static_cast<double>(d.joined.whole.mesh.hexes.size()); };
    const auto miss = [&](const Draft& d) { return std::abs(cells(d) / wanted_cells() - 1); };
    for (int round = 0; round < kSearchTuning.recounts && miss(draft) > kSearchTuning.padded_miss; ++round) {
      std::optional<Draft> next = again(base, options_.divisions, draft.grid_hexes / cells(draft), "another number of cells");
      if (!next || miss(*next) >= miss(draft)) return;
      draft = std::move(*next);
    }
  }

  /// Padding can add cells to a division that has a maximum: fewer are asked for then.
  void retry_padded(const Base& base, Draft& draft) {
    const Divisions fewer = allow_for_padding(draft);
    if (fewer == options_.divisions) return;
    std::optional<Draft> next = again(base, fewer, 1, "fewer divisions");
    if (next && unmet(next->before_refining()).size() < unmet(draft.before_refining()).size()) draft = std::move(*next);
  }

  bool has_face(std::size_t s, int face) const {
    const std::vector<int>& faces = assembly_.solids[static_cast<std::size_t>(model_.numbers[s]) - 1].faces();
    return std::binary_search(faces.begin(), faces.end(), face);
  }
  bool is_first_with(int face, std::size_t s) const {
    for (std::size_t before = 0; before < s; ++before)
      if (has_face(before, face)) return false;
    return has_face(s, face);
  }

  /// The first solid that has what a division is of, in all.
  bool is_of(const Division& d, std::size_t s) const {
    const auto owns = [&](std::size_t solid) {
      const CadModel& cad = assembly_.solids[static_cast<std::size_t>(model_.numbers[solid]) - 1];
      const auto has = [](const std::vector<int>& numbers, int id) { return std::binary_search(numbers.begin(), numbers.end(), id); };
      return d.solid == 0 && (d.edge > 0 ? has(cad.edges(), d.edge) : has(cad.faces(), d.faces[0]) && has(cad.faces(), d.faces[1]));
    };
    for (std::size_t before = 0; before < s; ++before)
      if (owns(before)) return false;
    return owns(s);
  }

  Divisions allow_for_padding(const Draft& draft) const {
    Divisions fewer = options_.divisions;
    const std::vector<PaddedMesh>& solids = draft.before_refining();
    for (std::size_t s = 0; s < solids.size() && !fewer.empty(); ++s) {
      const Association own = by_origin(solids[s].association, model_.origins[s]);
      for (Division& d : fewer)
        if (is_of(d, s)) d = polycube::allow_for_padding(solids[s].mesh, own, {d}).front();
    }
    return fewer;
  }

  std::vector<std::string> unmet(const std::vector<PaddedMesh>& solids) const {
    std::vector<std::string> lines;
    for (std::size_t s = 0; s < solids.size(); ++s) {
      Divisions own = options_.divisions;
      std::erase_if(own, [&](const Division& d) { return !is_of(d, s); });
      if (own.empty()) continue;
      const auto more = unmet_divisions(solids[s].mesh, by_origin(solids[s].association, model_.origins[s]), own);
      lines.insert(lines.end(), more.begin(), more.end());
    }
    return lines;
  }

  /// `share`: of the grid's cells among all, where a number of them is asked for.
  Quantization quantized(const Base& base, const Divisions& divisions, double share) const {
    auto chains = edge_chains(model_.outer, base.s.tets);
    const MeshOptions demands = by_entity(divisions);
    IntegerOptions wanted;
    wanted.scale = options_.coarsest ? kSearchTuning.coarsest : finer_ / size_;
    if (options_.hexes > 0) wanted.wanted_cells = share * std::pow(finer_, 3) * wanted_cells();
    wanted.growth = options_.growth;
    wanted.coarsest = options_.coarsest;
    wanted.demanded = [&](double scale) {
      try {
        QuantizeOptions asked = quantize_options(base.places, base.s.tets, base.s.map, base.s.blocks, demands, scale);
        asked.constraints.insert(asked.constraints.end(), base.walls.begin(), base.walls.end());
        return asked;
      } catch (const StageFailed& e) {
        throw as_joined(e, model_);
      }
    };
    wanted.room = room_for_vertices(model_.outer, base.s.tets, base.s.map, base.s.blocks, chains, structures_.ignored());
    const std::vector<char>& held = structures_.interface_edges();
    chains = all_edge_chains(model_, base.s.tets);
    for (const FeatureEdge& e : base.s.features.edges)
      if (e.capture == EdgeCapture::kLost && !held[static_cast<std::size_t>(e.edge)]) chains[e.edge].clear();
    wanted.bounds = part_bounds(model_.whole, base.s.tets, base.s.map, base.s.blocks, chains, options_);
    return find_integers(base.s.blocks, base.s.map, wanted, monitor_).quantization;
  }

  /// A grid with its paddings, not fitted.
  struct Laid {
    Draft draft;
    HexComplex hexes;
    std::vector<SolidGrid> grids;
    std::vector<PaddedGrids> choices;
  };

  Laid laid(const Base& base, const Divisions& divisions, double share) {
    Laid result;
    Draft& draft = result.draft;
    draft.quantization = clock_.stage("quantize", [&] { return quantized(base, divisions, share); });
    HexComplex& hexes = result.hexes;
    hexes = clock_.stage("hex", [&] {
      const std::vector<int>& value = draft.quantization.value;
      Spacing spacing = graded_spacing(base.s.blocks, base.s.map, value, options_.growth);
      try {
        bias_edges(base.places.edge_chains, base.s.tets, base.s.map, base.s.blocks, options_.bias, value, spacing);
      } catch (const StageFailed& e) {
        throw as_joined(e, model_);
      }
      return build_hexes(base.s.tets, base.s.map, base.s.blocks, draft.quantization, monitor_, spacing);
    });
    monitor_.log("hex: " + std::to_string(base.s.blocks.blocks.size()) + " blocks, " + std::to_string(hexes.mesh.hexes.size()) + " hexes");
    draft.grid_hexes = static_cast<double>(hexes.mesh.hexes.size());
    draft.finer = finer_;
    draft.charts = static_cast<int>(base.s.map.charts.size());
    draft.blocks = static_cast<int>(base.s.blocks.blocks.size());
    std::vector<int> hex_solid;
    for (const int b : hexes.hex_block) hex_solid.push_back(base.s.block_solid[b]);
    try {
      pad_solids(base, hex_solid, result);
    } catch (const StageFailed& e) {
      if (e.stage() != "interfaces") throw;
      monitor_.log("conform: " + std::string(e.what()) + ": once more, each on the CAD edges of those before it, and of those after it");
      pad_in_order(base, hex_solid, result);
    }
    return result;
  }

  /// Each solid finds the ways of CAD edges on the grid for itself.
  void pad_solids(const Base& base, const std::vector<int>& hex_solid, Laid& made) {
    SolidChoices found(model_.solids.size());
    for (std::size_t s = 0; s < found.size(); ++s) found[s] = pad_solid(static_cast<int>(s), base, made.hexes, hex_solid, nullptr);
    made.choices = paddings(found, made.hexes.mesh.points.size());
    for (SolidChoice& f : found) made.grids.push_back(std::move(f.grid));
  }

  /// Each solid takes those where interfaces end from the solids done before it, from the first to the last one and the other way round.
  void pad_in_order(const Base& base, const std::vector<int>& hex_solid, Laid& made) {
    std::optional<StageFailed> failure;
    for (const bool forward : {true, false}) {
      SolidChoices found(model_.solids.size());
      InterfacePaths paths;
      for (std::size_t i = 0; i < found.size(); ++i) {
        const std::size_t s = forward ? i : found.size() - 1 - i;
        found[s] = pad_solid(static_cast<int>(s), base, made.hexes, hex_solid, &paths);
      }
      try {
        std::vector<PaddedGrids> more = paddings(found, made.hexes.mesh.points.size());
        std::move(more.begin(), more.end(), std::back_inserter(made.choices));
      } catch (const StageFailed& e) {
        failure = e;
      }
      made.grids.clear();
      for (SolidChoice& f : found) made.grids.push_back(std::move(f.grid));
    }
    if (made.choices.empty()) throw StageFailed(*failure);
  }

  Draft gridded(const Base& base, const Divisions& divisions, double share) {
    auto [draft, hexes, grids, choices] = laid(base, divisions, share);
    fit_choices(draft, std::move(choices));
    for (const auto& hex_of : draft.joined.hex) draft.hex_block.resize(draft.hex_block.size() + hex_of.size(), -1);
    for (std::size_t s = 0; s < grids.size(); ++s) {
      std::vector<int> own;
      for (const int h : grids[s].hex) own.push_back(options_.coarsest ? h : hexes.hex_block[h]);
      own = carry_blocks(draft.solids[s].mesh, std::move(own));
      for (std::size_t h = 0; h < own.size(); ++h) draft.hex_block[draft.joined.hex[s][h]] = own[h];
    }
    if (!options_.refine.empty()) refine(draft);
    for (std::size_t s = 0; s < draft.solids.size(); ++s) {
      HexMesh& mesh = draft.solids[s].mesh;
      for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] = draft.joined.whole.mesh.points[draft.joined.node[s][p]];
      gate(model_.solids[s], draft.solids[s], options_.threads, monitor_);
    }
    return std::move(draft);
  }

  RefinePlan places_of(const JoinedGrids& joined) const {
    RefinePlan plan;
    plan.everywhere = options_.refine;
    plan.pieces = pieces_of(model_);
    plan.hex_solid.resize(joined.whole.mesh.hexes.size());
    for (std::size_t s = 0; s < joined.hex.size(); ++s)
      for (const int h : joined.hex[s]) plan.hex_solid[h] = model_.numbers[s];
    return plan;
  }

  /// Locally, in all solids at once: templates go on through interfaces.
  void refine(Draft& draft) {
    const RefinePlan plan = places_of(draft.joined);
    LocallyRefined refined = clock_.stage("refine", [&] { return refine_locally(model_.whole, draft.joined.whole, plan, fit_options(), monitor_); });
    draft.fitted = refined.fitted;
    fail_inverted(draft.fitted);
    std::vector<int> hex_solid, hex_block;
    for (const int parent : refined.parent) {
      const int number = plan.hex_solid[parent];
      hex_solid.push_back(static_cast<int>(std::find(model_.numbers.begin(), model_.numbers.end(), number) - model_.numbers.begin()));
      hex_block.push_back(draft.hex_block[parent]);
    }
    PaddedGrids parts = part_grids(model_, std::move(refined.padded), hex_solid, draft.solids, monitor_);
    draft.unrefined = std::exchange(draft.solids, std::move(parts.solids));
    draft.joined = std::move(parts.joined);
    draft.hex_block = std::move(hex_block);
    draft.refine_warnings = std::move(refined.warnings);
  }

  FitOptions fit_options() const {
    FitOptions result;
    result.threads = thread_count(options_.threads);
    return result;
  }

  static void fail_inverted(const FitReport& fitted) {
    if (fitted.inverted == 0) return;
    std::vector<CadRef> faces;
    for (const int f : fitted.bad_faces) faces.push_back({2, f});
    throw StageFailed("fit", std::to_string(fitted.inverted) + " cells stay inverted", faces);
  }

  /// CAD faces that a solid has in common with others, ascending.
  std::vector<int> interfaces_of(int s) const {
    std::vector<int> faces;
    for (const auto& [face, solids] : model_.interfaces)
      if (solids[0] == s || solids[1] == s) faces.push_back(face);
    return faces;
  }

  /// Those of a solid's own nodes; some may not be among them.
  static std::map<int, std::vector<int>> paths_on(const SolidGrid& grid, const CadModel& model, const InterfacePaths& paths) {
    std::map<int, int> own;
    for (std::size_t n = 0; n < grid.node.size(); ++n) own[grid.node[n]] = static_cast<int>(n);
    std::map<int, std::vector<int>> result;
    for (const int e : model.edges()) {
      const auto path = paths.find(e);
      if (path == paths.end() || !std::all_of(path->second.begin(), path->second.end(), [&](int n) { return own.contains(n); })) continue;
      for (const int n : path->second) result[e].push_back(own.at(n));
    }
    return result;
  }

  void add_paths(const SolidGrid& grid, const Association& association, InterfacePaths& paths) const {
    InterfacePaths found;
    for (std::size_t i = 0; i < association.segments.size(); ++i) {
      const int e = association.segment_edge[i];
      if (!structures_.interface_edges()[static_cast<std::size_t>(e)]) continue;
      std::vector<int>& path = found[e];
      if (path.empty()) path.push_back(grid.node[association.segments[i][0]]);
      path.push_back(grid.node[association.segments[i][1]]);
    }
    paths.merge(found);
  }

  SolidChoice pad_solid(int s, const Base& base, const HexComplex& hexes, const std::vector<int>& hex_solid, InterfacePaths* paths) {
    SolidChoice result;
    const CadModel& model = model_.solids[s];
    std::vector<int> points;
    const TetMesh own = tets_of_solid(base.s.tets, s, &points);
    const std::vector<Chart> charts = charts_of_solid(base.s.tets, points, own, base.s.map, base.s.between.chart);
    const SolidGrid& grid = result.grid = grid_of_solid(hexes, hex_solid, s, own, points, base.s.map, charts);
    AssociateOptions how;
    how.ignored = structures_.ignored();
    how.edge_chains = edge_chains(model, own);
    how.size = typical_edge(grid.mesh);
    if (paths) how.given_paths = paths_on(grid, model, *paths);
    clock_.stage("pad", [&] {
      const Association association = associate(model, own, charts, {grid.mesh.points, grid.quads, grid.quad_chart, grid.quad_triangle}, how, monitor_);
      if (paths) add_paths(grid, association, *paths);
      std::vector<PadReport> reports;
      std::vector<PaddedMesh>& kept = result.padded;
      std::vector<int>& hexes_added = result.added_hexes;
      std::vector<PaddedMesh> all = pad_choices(model, grid.mesh, association, monitor_, &reports, interfaces_of(s), thread_count(options_.threads));
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (!keeps_interfaces(model_, association, all[i].association)) continue;
        kept.push_back(std::move(all[i]));
        hexes_added.push_back(reports[i].added_hexes);
      }
      // Layers that have to go under interfaces may bring less than none.
      if (kept.empty() || hexes_added.front() > 0) {
        kept.push_back({grid.mesh, association});
        hexes_added.push_back(0);
      }
    });
    return result;
  }

  /// The best of all solids, then the second best of those that have one, and so on; the last is without layers. Then that one with layers through several
  /// solids, and with those of each solid on top of them; where there are none of these, layers through several solids on top of the first.
  std::vector<PaddedGrids> paddings(const SolidChoices& choices, std::size_t nodes) {
    std::vector<SolidGrid> grids;
    std::size_t most = 1;
    for (const SolidChoice& c : choices) {
      grids.push_back(c.grid);
      most = std::max(most, c.padded.size());
    }
    std::vector<PaddedGrids> result;
    for (std::size_t i = 0; i < most; ++i) {
      PaddedGrids& chosen = result.emplace_back();
      for (std::size_t s = 0; s < choices.size(); ++s) {
        const std::size_t own = std::min(i, choices[s].padded.size() - 1);
        chosen.solids.push_back(choices[s].padded[own]);
        chosen.added_hexes.push_back(choices[s].added_hexes[own]);
      }
      chosen.joined = join_grids(model_, grids, chosen.solids, nodes);
    }
    std::vector<PaddedGrids> through = clock_.stage("pad", [&] {
      std::vector<PaddedGrids> across = pad_across(model_, result.back(), monitor_);
      if (across.empty() && most > 1) across = pad_across(model_, result.front(), monitor_);
      if (across.size() > kPipelineTuning.conform_across) across.resize(kPipelineTuning.conform_across);
      if (across.empty()) return across;
      std::optional<PaddedGrids> more = pad_each(across.front());
      if (more) across.push_back(std::move(*more));
      return across;
    });
    monitor_.log("conform: " + std::to_string(most) + " paddings of solids, " + std::to_string(through.size()) + " through several");
    // Beside them the second best of each solid was never the best of all (on 70 parts), and to look at it costs as much as at the others.
    if (!through.empty() && most > 2) result.erase(result.begin() + 1, result.end() - 1);
    std::move(through.begin(), through.end(), std::back_inserter(result));
    return result;
  }

  /// Layers of each solid on top of those through several; none where no solid has any.
  std::optional<PaddedGrids> pad_each(const PaddedGrids& across) const try {
    PaddedGrids result;
    std::vector<SolidGrid> grids(across.solids.size());
    bool more = false;
    for (std::size_t s = 0; s < across.solids.size(); ++s) {
      grids[s].node = across.joined.node[s];
      PaddedMesh best = across.solids[s];
      std::vector<PadReport> reports;
      std::vector<PaddedMesh> all =
          pad_choices(model_.solids[s], best.mesh, best.association, monitor_, &reports, interfaces_of(static_cast<int>(s)), thread_count(options_.threads));
      const auto kept = std::find_if(all.begin(), all.end(), [&](const PaddedMesh& p) { return keeps_interfaces(model_, best.association, p.association); });
      const int added = kept == all.end() ? 0 : reports[static_cast<std::size_t>(kept - all.begin())].added_hexes;
      if (added > 0) best = std::move(*kept);
      more = more || added > 0;
      result.solids.push_back(std::move(best));
      result.added_hexes.push_back(across.added_hexes[s] + added);
    }
    if (!more) return std::nullopt;
    result.joined = join_grids(model_, grids, result.solids, across.joined.whole.mesh.points.size());
    return result;
  } catch (const StageFailed& e) {
    monitor_.log("conform: layers of each solid on those through several: " + std::string(e.what()));
    return std::nullopt;
  }

  static std::vector<FitCandidate> candidates_of(std::vector<PaddedGrids>& choices) {
    std::vector<FitCandidate> candidates;
    candidates.reserve(choices.size());
    for (PaddedGrids& c : choices) candidates.push_back({c.joined.whole.mesh, c.joined.whole.association});
    return candidates;
  }

  void fit_choices(Draft& draft, std::vector<PaddedGrids> choices) {
    const std::vector<FitCandidate> candidates = candidates_of(choices);
    const auto good = [](std::size_t, const FitReport& r) { return r.inverted == 0 && r.min_scaled_jacobian >= kSearchTuning.good_scaled_jacobian; };
    const FitChoice best = clock_.stage("fit", [&] { return fit_best(model_.whole, candidates, fit_options(), kPipelineTuning.conform_fits, good, monitor_); });
    draft.fitted = best.report;
    monitor_.log("fit: min SJ " + std::to_string(draft.fitted.min_scaled_jacobian) + ", mean " + std::to_string(draft.fitted.mean_scaled_jacobian) + ", " +
                 std::to_string(draft.fitted.inverted) + " inverted, choice " + std::to_string(best.index + 1) + " of " + std::to_string(choices.size()));
    fail_inverted(draft.fitted);
    draft.joined = std::move(choices[best.index].joined);
    draft.solids = std::move(choices[best.index].solids);
    draft.padded_hexes = std::move(choices[best.index].added_hexes);
  }

  ConformalMesh finished(Draft& draft, int tried) {
    ConformalMesh result;
    // A mesh that is there is handed out, late or not.
    const Monitor finishing(monitor_, out_of_time_ ? Monitor::Clock::time_point::max() : monitor_.deadline());
    result.fem = clock_.stage("fem", [&] {
      FemMesh fem = build_fem_mesh(model_.whole, draft.joined.whole.mesh, draft.joined.whole.association, {options_.order, options_.threads}, finishing);
      fem.hex_block = draft.hex_block;
      std::vector<int> hex_solid(fem.hexes.size(), 0);
      for (std::size_t s = 0; s < draft.joined.hex.size(); ++s)
        for (const int h : draft.joined.hex[s]) hex_solid[h] = static_cast<int>(s);
      name_by_origin(fem, model_, hex_solid, draft.joined.whole.association.point_cad);
      return fem;
    });
    for (std::size_t s = 0; s < draft.solids.size(); ++s)
      result.reports.push_back({assembly_.labels[static_cast<std::size_t>(model_.numbers[s]) - 1], report_of(draft, s, tried)});
    // What is of all is told once.
    MeshReport& first = result.reports.front().report;
    const int nodes = first.nodes;
    complete(first, result.fem);
    first.nodes = nodes;
    first.stages = clock_.records();
    if (draft.finer > 1) first.warnings.push_back("the cells are finer than asked for");
    const std::vector<std::string> lines = unmet(draft.solids);
    first.warnings.insert(first.warnings.end(), lines.begin(), lines.end());
    first.warnings.insert(first.warnings.end(), draft.refine_warnings.begin(), draft.refine_warnings.end());
    first.out_of_time = out_of_time_;
    if (out_of_time_) first.warnings.push_back("the time limit ended the search; this is the best mesh so far");
    return result;
  }

  MeshReport report_of(const Draft& draft, std::size_t s, int tried) const {
    const CadModel& model = model_.solids[s];
    const PaddedMesh& own = draft.solids[s];
    MeshReport r;
    r.version = POLYCUBE_VERSION;
    r.options = options_;
    r.size = of_solid(s).size > 0 ? of_solid(s).size : size_;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    r.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    r.tets = static_cast<int>(std::count(structures_.tets().tet_solid.begin(), structures_.tets().tet_solid.end(), static_cast<int>(s)));
    r.charts = s == 0 ? draft.charts : 0;
    r.blocks = s == 0 ? draft.blocks : 0;
    r.hexes = static_cast<int>(own.mesh.hexes.size());
    r.nodes = static_cast<int>(own.mesh.points.size());
    r.quality = summarise(own.mesh);
    r.shape = summarise_shape(own.mesh);
    for (const Hex& h : own.mesh.hexes) r.volume += hex_volume(own.mesh.points, h);
    r.cad_volume = model.volume();
    r.worst = worst_cells(own.mesh, own.association);
    r.padded_hexes = draft.padded_hexes[s];
    r.plan = "conform";
    r.plans_tried = s == 0 ? tried : 0;
    if (s == 0)
      r.quantization = {draft.quantization.objective, draft.quantization.bound, draft.quantization.gap(),    draft.quantization.optimal,
                        draft.quantization.nodes,     draft.quantization.cuts,  draft.quantization.c2_rounds};
    // Counted as the user knows them: an edge of several pieces is one.
    const Association by_number = by_origin(own.association, model_.origins[s]);
    const CadModel& before = assembly_.solids[static_cast<std::size_t>(model_.numbers[s]) - 1];
    std::vector<int> real;
    for (const int e : before.edges())
      if (!before.edge(e).seam && !before.edge(e).degenerate && !before.edge(e).tiny) real.push_back(e);
    r.capture = capture(by_number, static_cast<int>(before.vertices().size()), real, static_cast<int>(before.faces().size()));
    rename(r, model_.origins[s]);
    if (!draft.quantization.optimal && s == 0)
      r.warnings.push_back("the sizes of the cells could be better still: the best integers were not found within the search's nodes");
    const MeshOptions asked = of_solid(s);
    const Shortfalls short_of = find_shortfalls(before, own.mesh, by_number, effective_min_layers(asked), effective_per_circle(asked));
    r.thin_walls = static_cast<int>(short_of.thin_walls.size());
    r.coarse_circles = static_cast<int>(short_of.coarse_circles.size());
    for (const auto* lines : {&short_of.thin_walls, &short_of.coarse_circles}) r.warnings.insert(r.warnings.end(), lines->begin(), lines->end());
    LocalSizes sizes = options_.sizes;
    std::erase_if(sizes, [&](const LocalSize& l) { return l.solid > 0 ? l.solid != model_.numbers[s] : !is_first_with(l.face, s); });
    const auto other_sizes = unmet_sizes(own.mesh, by_number, sizes);
    r.warnings.insert(r.warnings.end(), other_sizes.begin(), other_sizes.end());
    r.loose_nodes = count_loose_nodes(model, own.association, own.mesh.points);
    for (const int e : r.capture.lost_edges) r.warnings.push_back(name({1, e}) + " has no mesh edges on it");
    const auto one = merged_faces(r.capture, by_number);
    r.warnings.insert(r.warnings.end(), one.begin(), one.end());
    return r;
  }

  /// Faces by the numbers that the user knows.
  static void rename(MeshReport& r, const Origin& origin) {
    for (WorstCell& cell : r.worst) {
      for (int& f : cell.faces) f = origin.faces[static_cast<std::size_t>(f)];
      std::sort(cell.faces.begin(), cell.faces.end());
      cell.faces.erase(std::unique(cell.faces.begin(), cell.faces.end()), cell.faces.end());
    }
  }

  const ConformalModel& model_;
  const Assembly& assembly_;
  const MeshOptions& options_;
  ConformalStructures& structures_;
  StageClock& clock_;
  const Monitor& monitor_;
  const double size_;
  double finer_ = 1;  ///< of the grid that is tried
  bool out_of_time_ = false;
};

}  // namespace

ConformalSession::ConformalSession(ConformalModel model, const Assembly& assembly, const MeshOptions& first)
    : model_(std::move(model)), assembly_(assembly), first_size_(size_of(first, assembly)) {}

ConformalSession::~ConformalSession() = default;

ConformalStructures& ConformalSession::structures(const MeshOptions& options, StageClock& clock, const Monitor& monitor) {
  if (tets_.tets.empty())
    tets_ = clock.stage("tet", [&] { return tetrahedralise(model_.whole, model_.solids, tet_options(first_size_, model_.outer.diagonal()), monitor); });
  const MeshOptions key = structural(options);
  if (!structures_ || key_ != key) {
    structures_.reset();
    structures_ = std::make_unique<ConformalStructures>(model_, tets_, options, first_size_);
    key_ = key;
  }
  return *structures_;
}

template <class Work>
auto ConformalSession::at_work(const MeshOptions& given, const Monitor& monitor, const Work& work) {
  try {
    const MeshOptions options = options_of_unit(given, model_, assembly_);
    check_demands(options, model_, assembly_, size_of(options, assembly_));
    StageClock clock(monitor);
    return work(options, structures(options, clock, monitor), clock);
  } catch (const StageFailed& failure) {
    throw by_origin(failure, model_);
  }
}

void ConformalSession::prepare(const MeshOptions& given, const Monitor& monitor) {
  at_work(given, monitor, [&](const MeshOptions&, ConformalStructures& structures, StageClock& clock) {
    try {
      structures.structure(0, clock, monitor);
    } catch (const StageFailed& e) {
      monitor.log(e.stage() + ": " + e.what());  // told by mesh()
    }
  });
}

ConformalMesh ConformalSession::mesh(const MeshOptions& given, const Monitor& monitor) {
  return at_work(given, monitor, [&](const MeshOptions& options, ConformalStructures& structures, StageClock& clock) {
    return Conformer(model_, assembly_, options, structures, clock, monitor).run();
  });
}

int ConformalSession::count(const MeshOptions& given, const Monitor& monitor) {
  return at_work(given, monitor, [&](const MeshOptions& options, ConformalStructures& structures, StageClock& clock) {
    return Conformer(model_, assembly_, options, structures, clock, monitor).count();
  });
}

LabelledPart ConformalSession::labels(const MeshOptions& given, const Monitor& monitor) {
  return at_work(given, monitor, [&](const MeshOptions&, ConformalStructures& structures, StageClock& clock) {
    LabelledPart part = labelled_solids(model_, structures.labels(0, clock, monitor), structures.ignored(), monitor);
    part.stages = clock.records();
    return part;
  });
}

}  // namespace polycube
