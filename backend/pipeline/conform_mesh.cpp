#include "pipeline/conform_mesh.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/error.h"
#include "core/parallel.h"
#include "fem/conform.h"
#include "fit/fit.h"
#include "label/frame.h"
#include "pad/associate.h"
#include "pipeline/block_ids.h"
#include "pipeline/bounds.h"
#include "pipeline/conform_grid.h"
#include "pipeline/conform_labels.h"
#include "pipeline/gate.h"
#include "pipeline/realise.h"
#include "pipeline/solids.h"
#include "pipeline/stage_clock.h"
#include "pipeline/structures.h"
#include "pipeline/vertex_room.h"
#include "tet/classify.h"
#include "tet/tet.h"

namespace polycube {
namespace {

// Labellings that are tried until one has a complete mesh with good cells, and paddings of each that are fitted (as a quick search of one solid tries).
constexpr int kLabellings = 4;
constexpr int kFits = 3;
// eta of section 6.2 for the coarsest mesh.
constexpr double kCoarsest = 1e-6;
// A labelling whose worst cell is as good as this ends the search (good_cells of one solid asks for no more).
constexpr double kGood = 0.2;

double typical_edge(const HexMesh& mesh) {
  double sum = 0;
  for (const Hex& h : mesh.hexes)
    sum += (mesh.points[h[0]] - mesh.points[h[1]]).norm() + (mesh.points[h[0]] - mesh.points[h[3]]).norm() + (mesh.points[h[0]] - mesh.points[h[4]]).norm();
  return sum / (3.0 * static_cast<double>(mesh.hexes.size()));
}

struct Draft {
  JoinedGrids joined;
  std::vector<PaddedMesh> solids;  ///< padded, each by its own numbers
  std::vector<int> hex_block;      ///< per hex of the whole
  FitReport fitted;
  std::vector<int> padded_hexes;  ///< per solid
  Quantization quantization;
  int charts = 0, blocks = 0;
  int lost() const {
    int sum = 0;
    for (const PaddedMesh& s : solids) sum += static_cast<int>(s.association.lost_edges.size());
    return sum;
  }
};

class Conformer {
 public:
  Conformer(const ConformalModel& model, const Assembly& assembly, const MeshOptions& options, const Monitor& monitor)
      : model_(model), assembly_(assembly), options_(options), monitor_(monitor), clock_(monitor), size_(size_of()) {}

  ConformalMesh run() {
    refuse_demands();
    tets_ = clock_.stage("tet", [&] { return tetrahedralise(model_.whole, model_.solids, tet_options(size_, model_.outer.diagonal()), monitor_); });
    const Mat3 frame = options_.frame.empty() ? find_frame(model_.outer) : frame_of(options_.frame);
    LabelOptions label = label_options(options_);
    label.face_labels = fused_labels();
    label.frame_given = true;
    label.frame = frame;
    std::optional<Draft> best;
    std::optional<StageFailed> failure;
    std::set<std::array<std::vector<int>, 2>> known;
    int tried = 0;
    for (int i = 0; i < kLabellings; ++i) {
      try {
        ++tried;
        const ConformalLabels labels = clock_.stage("label", [&] { return label_conformally(model_, tets_, label, i, monitor_); });
        if (!known.insert({labels.labelling.label, labels.inner_label}).second) continue;
        Draft draft = drafted(labels);
        const auto rank = [](const Draft& d) { return std::pair(-d.lost(), d.fitted.min_scaled_jacobian); };
        if (!best || rank(draft) > rank(*best)) best = std::move(draft);
        if (best->lost() == 0 && best->fitted.min_scaled_jacobian >= kGood) break;
      } catch (const StageFailed& e) {
        monitor_.log("conform: " + e.stage() + ": " + e.what());
        if (!failure || e.stage() == "interfaces") failure = e;
      } catch (const OutOfTime&) {
        if (!best) throw;
        out_of_time_ = true;
        break;
      }
    }
    if (!best) throw *failure;
    return finished(*best, tried);
  }

 private:
  double size_of() const {
    if (options_.hexes > 0) return std::cbrt(assembly_.volume() / options_.hexes);
    return effective_size(options_, assembly_.diagonal());
  }

  void refuse_demands() const {
    const bool by_entity = std::any_of(options_.sizes.begin(), options_.sizes.end(), [](const LocalSize& s) { return s.solid == 0; }) ||
                           std::any_of(options_.divisions.begin(), options_.divisions.end(), [](const Division& d) { return d.solid == 0; });
    if (by_entity || !options_.bias.empty())
      throw InvalidInput(
          "--bias, --sizes and --divisions of faces, edges and axes go with --interfaces separate only; those of solids go with common nodes too");
    if (!options_.refine.empty()) throw InvalidInput("--refine goes with --interfaces separate only: the solids touch");
    if (options_.feature_angle > 0) throw InvalidInput("--feature-angle goes with --interfaces separate only");
  }

  /// A label of the assembly's face is one of all faces that it became.
  FaceLabels fused_labels() const {
    FaceLabels labels;
    for (const auto& [face, label] : options_.labels) {
      for (const Origin& origin : model_.origins)
        for (std::size_t f = 1; f < origin.faces.size(); ++f)
          if (origin.faces[f] == face && std::binary_search(model_.outer.faces().begin(), model_.outer.faces().end(), static_cast<int>(f)))
            labels.emplace_back(static_cast<int>(f), label);
    }
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
  }

  /// What is asked of a solid, by its number in the assembly.
  MeshOptions of_solid(std::size_t s) const {
    MeshOptions own = options_;
    std::erase_if(own.sizes, [&](const LocalSize& l) { return l.solid != model_.numbers[s]; });
    std::erase_if(own.divisions, [&](const Division& d) { return d.solid != model_.numbers[s]; });
    own.size = 0;
    return without_solids(own);
  }

  QuantizeOptions asked(BlockComplex& blocks, const PolycuboidMap& map, const std::vector<int>& block_solid) const {
    QuantizeOptions result;
    result.scale = options_.coarsest ? kCoarsest : 1 / size_;
    std::vector<int> layers;
    std::vector<char> may_yield;
    std::vector<double> scale;
    for (std::size_t s = 0; s < model_.solids.size(); ++s) {
      const MeshOptions own = of_solid(s);
      layers.push_back(effective_min_layers(own));
      may_yield.push_back(own.min_layers == 0);
      scale.push_back(own.size > 0 && !options_.coarsest ? size_ / own.size : 1.0);
    }
    result.constraints = part_at_interfaces(blocks, map, block_solid, layers, may_yield);
    if (std::any_of(scale.begin(), scale.end(), [](double x) { return x != 1; }))
      for (const int s : block_solid) result.block_scale.push_back(scale[static_cast<std::size_t>(s)]);
    return result;
  }

  /// CAD edges where interfaces end: the charts of these hold them.
  std::vector<char> interface_edges() const {
    std::vector<char> edges(static_cast<std::size_t>(model_.whole.edge_count()) + 1, 0);
    for (const auto& interface : model_.interfaces)
      for (const int e : model_.whole.face(interface.first).edges) edges[static_cast<std::size_t>(e)] = 1;
    return edges;
  }

  Draft drafted(const ConformalLabels& labels) {
    Draft draft;
    const TetMesh& tets = labels.mesh;
    const InterfaceCharts between = interface_charts(labels);
    Features features = clock_.stage("label", [&] { return find_features(model_.outer, tets, labels.labelling, interface_edges(), monitor_); });
    DeformOptions deform_options;
    deform_options.merge = merge_distance(size_, model_.outer.diagonal());
    deform_options.threads = thread_count(options_.threads);
    const RealisedMap realised =
        clock_.stage("deform", [&] { return realise(model_.outer, tets, labels.labelling, features, deform_options, monitor_, between.charts); });
    const PolycuboidMap& map = realised.map;
    monitor_.log("deform: " + std::to_string(map.charts.size()) + " charts, " + std::to_string(realised.report.flipped) + " flipped of " +
                 std::to_string(tets.tets.size()) + " tets");
    BlockComplex blocks = clock_.stage("blocks", [&] { return extract_blocks(tets, map, monitor_); });
    const std::vector<int> block_solid = solids_of_blocks(tets, map, blocks);
    draft.quantization = clock_.stage("quantize", [&] {
      QuantizeOptions demanded = asked(blocks, map, block_solid);
      const auto add = [&](const std::vector<DistanceConstraint>& more) { demanded.constraints.insert(demanded.constraints.end(), more.begin(), more.end()); };
      const std::vector<char> held = interface_edges();
      auto chains = edge_chains(model_.outer, tets);
      add(room_for_vertices(model_.outer, tets, map, blocks, chains, std::vector<char>(held.size(), 0)));
      for (const FeatureEdge& e : features.edges)
        if (e.capture == EdgeCapture::kLost && !held[static_cast<std::size_t>(e.edge)]) chains[e.edge].clear();
      add(part_bounds(model_.outer, tets, map, blocks, chains, options_));
      return quantize(blocks, map, demanded, monitor_);
    });
    const HexComplex hexes = clock_.stage("hex", [&] { return build_hexes(tets, map, blocks, draft.quantization, monitor_); });
    monitor_.log("hex: " + std::to_string(blocks.blocks.size()) + " blocks, " + std::to_string(hexes.mesh.hexes.size()) + " hexes");
    draft.charts = static_cast<int>(map.charts.size());
    draft.blocks = static_cast<int>(blocks.blocks.size());
    std::vector<int> hex_solid;
    for (const int b : hexes.hex_block) hex_solid.push_back(block_solid[b]);
    std::vector<SolidGrid> grids;
    std::vector<std::vector<PaddedMesh>> choices;
    std::vector<std::vector<int>> added;
    for (int s = 0; s < static_cast<int>(model_.solids.size()); ++s) pad_solid(s, tets, map, between.chart, hexes, hex_solid, grids, choices, added);
    fit_choices(draft, grids, choices, added, hexes.mesh.points.size());
    for (const auto& hex_of : draft.joined.hex) draft.hex_block.resize(draft.hex_block.size() + hex_of.size(), -1);
    for (std::size_t s = 0; s < grids.size(); ++s) {
      std::vector<int> own;
      for (const int h : grids[s].hex) own.push_back(options_.coarsest ? h : hexes.hex_block[h]);
      own = carry_blocks(draft.solids[s].mesh, std::move(own));
      for (std::size_t h = 0; h < own.size(); ++h) draft.hex_block[draft.joined.hex[s][h]] = own[h];
    }
    return draft;
  }

  /// CAD faces that a solid has in common with others, ascending.
  std::vector<int> interfaces_of(int s) const {
    std::vector<int> faces;
    for (const auto& [face, solids] : model_.interfaces)
      if (solids[0] == s || solids[1] == s) faces.push_back(face);
    return faces;
  }

  void pad_solid(int s, const TetMesh& tets, const PolycuboidMap& map, const std::vector<int>& inner_chart, const HexComplex& hexes,
                 const std::vector<int>& hex_solid, std::vector<SolidGrid>& grids, std::vector<std::vector<PaddedMesh>>& choices,
                 std::vector<std::vector<int>>& added) {
    const CadModel& model = model_.solids[s];
    std::vector<int> points;
    const TetMesh own = tets_of_solid(tets, s, &points);
    const std::vector<Chart> charts = charts_of_solid(tets, points, own, map, inner_chart);
    const SolidGrid& grid = grids.emplace_back(grid_of_solid(hexes, hex_solid, s, own, points, map, charts));
    AssociateOptions how;
    how.edge_chains = edge_chains(model, own);
    how.size = typical_edge(grid.mesh);
    clock_.stage("pad", [&] {
      const Association association = associate(model, own, charts, {grid.mesh.points, grid.quads, grid.quad_chart, grid.quad_triangle}, how, monitor_);
      std::vector<PadReport> reports;
      std::vector<PaddedMesh> kept;
      std::vector<int> hexes_added;
      std::vector<PaddedMesh> all = pad_choices(model, grid.mesh, association, monitor_, &reports, interfaces_of(s));
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
      choices.push_back(std::move(kept));
      added.push_back(std::move(hexes_added));
    });
  }

  /// The best of all solids, then the second best of those that have one, and so on; the last is without layers.
  void fit_choices(Draft& draft, const std::vector<SolidGrid>& grids, const std::vector<std::vector<PaddedMesh>>& choices,
                   const std::vector<std::vector<int>>& added, std::size_t nodes) {
    std::size_t most = 1;
    for (const auto& c : choices) most = std::max(most, c.size());
    std::vector<JoinedGrids> joined;
    std::vector<std::vector<PaddedMesh>> solids;
    for (std::size_t i = 0; i < most; ++i) {
      auto& chosen = solids.emplace_back();
      for (const auto& c : choices) chosen.push_back(c[std::min(i, c.size() - 1)]);
      joined.push_back(join_grids(model_, grids, chosen, nodes));
    }
    std::vector<FitCandidate> candidates;
    for (JoinedGrids& j : joined) candidates.push_back({j.whole.mesh, j.whole.association});
    FitOptions fit_options;
    fit_options.threads = thread_count(options_.threads);
    const auto good = [](std::size_t, const FitReport& r) { return r.inverted == 0 && r.min_scaled_jacobian >= kGood; };
    const FitChoice best = clock_.stage("fit", [&] { return fit_best(model_.whole, candidates, fit_options, kFits, good, monitor_); });
    draft.fitted = best.report;
    monitor_.log("fit: min SJ " + std::to_string(draft.fitted.min_scaled_jacobian) + ", mean " + std::to_string(draft.fitted.mean_scaled_jacobian) + ", " +
                 std::to_string(draft.fitted.inverted) + " inverted");
    if (draft.fitted.inverted > 0) {
      std::vector<CadRef> faces;
      for (const int f : draft.fitted.bad_faces) faces.push_back({2, f});
      throw StageFailed("fit", std::to_string(draft.fitted.inverted) + " cells stay inverted", faces);
    }
    draft.joined = std::move(joined[best.index]);
    draft.solids = std::move(solids[best.index]);
    for (std::size_t s = 0; s < draft.solids.size(); ++s) {
      draft.padded_hexes.push_back(added[s][std::min(best.index, added[s].size() - 1)]);
      HexMesh& mesh = draft.solids[s].mesh;
      for (std::size_t p = 0; p < mesh.points.size(); ++p) mesh.points[p] = draft.joined.whole.mesh.points[draft.joined.node[s][p]];
      gate(model_.solids[s], draft.solids[s], options_.threads, monitor_);
    }
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
    r.tets = static_cast<int>(std::count(tets_.tet_solid.begin(), tets_.tet_solid.end(), static_cast<int>(s)));
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
    std::vector<int> real;
    for (const int e : model.edges())
      if (!model.edge(e).seam && !model.edge(e).degenerate && !model.edge(e).tiny) real.push_back(e);
    r.capture = capture(own.association, static_cast<int>(model.vertices().size()), real, static_cast<int>(model.faces().size()));
    rename(r, model_.origins[s]);
    for (const int e : r.capture.lost_edges) r.warnings.push_back(name({1, e}) + " has no mesh edges on it");
    return r;
  }

  /// Entities by the numbers that the user knows; what the joining made anew has none.
  static void rename(MeshReport& r, const Origin& origin) {
    const auto renamed = [](std::vector<int>& numbers, const std::vector<int>& before) {
      for (int& n : numbers) n = before[static_cast<std::size_t>(n)];
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      std::erase(numbers, 0);
    };
    renamed(r.capture.lost_faces, origin.faces);
    renamed(r.capture.lost_edges, origin.edges);
    renamed(r.capture.lost_vertices, origin.vertices);
    for (WorstCell& cell : r.worst) renamed(cell.faces, origin.faces);
  }

  const ConformalModel& model_;
  const Assembly& assembly_;
  const MeshOptions& options_;
  const Monitor& monitor_;
  StageClock clock_;
  const double size_;
  TetMesh tets_;
  bool out_of_time_ = false;
};

/// The faces at fault by the numbers of the assembly.
StageFailed by_origin(const StageFailed& failure, const ConformalModel& model) {
  std::vector<CadRef> entities;
  for (const CadRef& entity : failure.entities()) {
    for (const Origin& origin : model.origins) {
      const std::vector<int>& before = entity.dim == 2 ? origin.faces : entity.dim == 1 ? origin.edges : origin.vertices;
      if (static_cast<std::size_t>(entity.id) < before.size() && before[static_cast<std::size_t>(entity.id)] > 0)
        entities.push_back({entity.dim, before[static_cast<std::size_t>(entity.id)]});
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  return StageFailed(failure.stage(), failure.what(), entities);
}

}  // namespace

ConformalMesh mesh_conformally(const ConformalModel& model, const Assembly& assembly, const MeshOptions& options, const Monitor& monitor) {
  try {
    return Conformer(model, assembly, options, monitor).run();
  } catch (const StageFailed& failure) {
    throw by_origin(failure, model);
  }
}

}  // namespace polycube
