#include "pipeline/search/evaluator.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "core/quality.h"
#include "fit/fit.h"
#include "hex/hex.h"
#include "pad/associate.h"
#include "pad/concentric.h"
#include "pad/pad.h"
#include "pipeline/block_ids.h"
#include "pipeline/bounds.h"
#include "pipeline/circles.h"
#include "pipeline/demands.h"
#include "pipeline/edge_runs.h"
#include "pipeline/gate.h"
#include "pipeline/integers.h"
#include "pipeline/local_refinement.h"
#include "pipeline/search/give_up.h"
#include "pipeline/search/tuning.h"
#include "pipeline/shortfalls.h"
#include "pipeline/tuning.h"
#include "pipeline/vertex_room.h"
#include "quantize/quantize.h"

namespace polycube {
namespace {

/// CAD edges on a grid, and where they lack room.
struct Routed {
  Association association;
  std::vector<CrowdedCorner> crowded;
};

double typical_edge(const HexMesh& mesh) {
  double sum = 0;
  for (const Hex& h : mesh.hexes) {
    sum += (mesh.points[h[0]] - mesh.points[h[1]]).norm() + (mesh.points[h[0]] - mesh.points[h[3]]).norm() + (mesh.points[h[0]] - mesh.points[h[4]]).norm();
  }
  return sum / (3.0 * static_cast<double>(mesh.hexes.size()));
}

Score score_of(const CadModel& model, double least, const PaddedMesh& m) {
  return {static_cast<int>(m.association.lost_edges.size()), static_cast<int>(m.association.lost_vertices.size()), least,
          free_scaled_jacobian(m.mesh, m.association), at_cad_bound(model, m.mesh, m.association)};
}

StageFailed inverted(const FitReport& fitted) {
  std::vector<CadRef> faces;
  for (int f : fitted.bad_faces) faces.push_back({2, f});
  return StageFailed("fit", std::to_string(fitted.inverted) + " cells stay inverted", faces);
}

}  // namespace

/// A mesh on the way: what plans that surrender edges start from.
struct Evaluator::Draft : Made {
  Plan plan;
  bool roomy = false;  // with cells enough for CAD edges that go on from each other
  EdgeLevels levels;   // round bores that are to be refined locally
  const Structure* structure = nullptr;
  HexComplex complex;
  Quantization quantization;
  AssociateOptions options;
  PaddedMesh padded;
  int choice = -1;  // of the padding plans
  FitReport fitted;
  int padded_hexes = 0;  // that padding added
  // Where cells were refined locally: the mesh before, and per hex its cell there.
  PaddedMesh unrefined;
  std::vector<int> parent;
  std::vector<std::string> refine_warnings;
  /// With the cells of the whole part alone.
  const PaddedMesh& before_refining() const { return parent.empty() ? padded : unrefined; }
};

const Evaluator::Draft& Evaluator::draft_in(const Outcome& outcome) { return static_cast<const Draft&>(*outcome.made); }

/// One evaluation, with the fits it may take.
class Evaluator::Work {
 public:
  Work(Evaluator& own, int fits)
      : own_(own), model_(own.model_), options_(own.options_), monitor_(own.monitor_), clock_(own.clock_), fits_(fits), fits_left_(fits) {}

  // Whether the bounds that the plan leaves out ask for nothing more than the rest: the plan with them was on the same grid.
  bool repeats_grid(const Plan& plan) {
    const Draft draft = on_grid(plan, false, options_.divisions);
    return std::find(own_.bounded_grids_.begin(), own_.bounded_grids_.end(), grid_of(draft)) != own_.bounded_grids_.end();
  }

  Outcome anew(const Plan& plan) {
    Draft draft = fitted(plan, options_.divisions);
    if (!draft.levels.empty() && draft.fitted.inverted > 0) {
      monitor_.log("refine: the grid goes through the whole part instead");
      may_refine_bores_ = false;
      draft = fitted(plan, options_.divisions);
    }
    if (options_.hexes > 0) recount(plan, draft);
    Outcome outcome = closed(std::move(draft));
    if (outcome.kind == Outcome::Kind::kMesh) retry_padded(plan, outcome);
    return counted(std::move(outcome));
  }

  // A mesh that misses an edge is worth more than none.
  Outcome surrendered(Draft draft, Surrender how) {
    const int rounds = how == Surrender::kEdges ? kSearchTuning.surrender_rounds : kSearchTuning.surrender_rings;
    Outcome outcome;
    outcome.failure = Failure{StageFailed("fit", "cells stay inverted, and no CAD edge is left to give up there"), {}};
    for (int round = 0; round < rounds && fits_left_ > 0; ++round) {
      if (how == Surrender::kAround) {
        give_up_around(model_, draft.padded, round, draft.options, monitor_);
      } else if (!give_up_edges(model_, options_.keep_faces, draft.padded, 1 << round, draft.options, monitor_)) {  // more and more, to come to an end
        break;
      }
      pad_and_fit(draft, divided(draft, routed(draft, draft.complex)));
      outcome = closed(draft);
      if (outcome.kind == Outcome::Kind::kMesh) break;
    }
    return counted(std::move(outcome));
  }

  // As the mesh would come to it, with the number of cells that is asked for met likewise.
  int count(const Plan& plan) {
    int cells = 0;
    for (int round = 0; round <= kSearchTuning.recounts; ++round) {
      Draft draft;
      const Association association = gridded(plan, options_.divisions, draft);
      std::vector<PaddedMesh> choices =
          clock_.stage("pad", [&] { return pad_choices(model_, draft.complex.mesh, association, monitor_, nullptr, {}, own_.threads_); });
      PaddedMesh& chosen = choices[promising(choices)];
      if (auto ringed = with_rings(chosen, draft)) chosen = std::move(*ringed);
      const auto padded = static_cast<int>(count_refined(chosen.mesh, chosen.association, places_of(draft, chosen.association), kAllLevels, monitor_));
      const auto miss = [&](int n) { return std::abs(static_cast<double>(n) / options_.hexes - 1); };
      if (round > 0 && miss(padded) >= miss(cells)) break;
      cells = padded;
      if (options_.hexes <= 0 || miss(cells) <= kSearchTuning.padded_miss) break;
      grid_share_ = static_cast<double>(draft.complex.mesh.hexes.size()) / padded;
    }
    return cells;
  }

 private:
  Outcome counted(Outcome outcome) const {
    outcome.fits = fits_ - fits_left_;
    return outcome;
  }

  static BoundedGrid grid_of(const Draft& draft) { return {draft.structure, draft.quantization.value}; }

  // What a draft comes to: a mesh, or what others may start from.
  Outcome closed(Draft draft) const {
    Outcome outcome;
    outcome.faults = draft.fitted.inverted + static_cast<int>(draft.padded.association.lost_edges.size());
    if (draft.fitted.inverted > 0) {
      outcome.failure = Failure{inverted(draft.fitted), {}};
    } else {
      try {
        const auto start = Monitor::Clock::now();
        gate(model_, draft.padded, options_.threads, monitor_);
        own_.gate_seconds_ = std::chrono::duration<double>(Monitor::Clock::now() - start).count();
        outcome.kind = Outcome::Kind::kMesh;
        outcome.score = score_of(model_, summarise(draft.padded.mesh).min_scaled_jacobian, draft.padded);
      } catch (const StageFailed& e) {
        outcome.failure = Failure{e, {}};
      }
    }
    outcome.made = std::make_shared<const Draft>(std::move(draft));
    return outcome;
  }

  // Where padding takes the number of cells away from the one asked for, a grid with its share of them.
  void recount(const Plan& plan, Draft& draft) {
    const auto miss = [&](const Draft& d) { return std::abs(static_cast<double>(d.padded.mesh.hexes.size()) / options_.hexes - 1); };
    for (int round = 0; round < kSearchTuning.recounts && miss(draft) > kSearchTuning.padded_miss && fits_left_ > 0; ++round) {
      grid_share_ = static_cast<double>(draft.complex.mesh.hexes.size()) / static_cast<double>(draft.padded.mesh.hexes.size());
      try {
        Draft next = fitted(plan, options_.divisions);
        if (next.fitted.inverted > draft.fitted.inverted || miss(next) >= miss(draft)) return;
        draft = std::move(next);
      } catch (const StageFailed& e) {
        monitor_.log("with another number of cells: " + e.stage() + ": " + e.what());
        return;
      }
    }
  }

  // Padding can add cells to a division that has a maximum: fewer are asked for then.
  void retry_padded(const Plan& plan, Outcome& outcome) {
    const PaddedMesh& padded = draft_in(outcome).before_refining();
    const auto unmet = [&](const PaddedMesh& m) { return unmet_divisions(m.mesh, m.association, options_.divisions).size(); };
    const Divisions fewer = allow_for_padding(padded.mesh, padded.association, options_.divisions);
    if (fewer == options_.divisions || fits_left_ <= 0) return;
    try {
      Outcome again = closed(fitted(plan, fewer));
      if (again.kind == Outcome::Kind::kMesh && unmet(draft_in(again).before_refining()) < unmet(padded)) outcome = std::move(again);
    } catch (const StageFailed& e) {
      monitor_.log("with fewer divisions: " + e.stage() + ": " + e.what());
    } catch (const InvalidInput& e) {
      monitor_.log(std::string("with fewer divisions: ") + e.what());
    }
  }

  Draft fitted(const Plan& plan, const Divisions& divisions) {
    Draft draft;
    const Association association = gridded(plan, divisions, draft);
    pad_and_fit(draft, association);
    return draft;
  }

  // The draft becomes the plan's, up to its CAD edges on its grid.
  Association gridded(const Plan& plan, const Divisions& divisions, Draft& draft) {
    levels_.clear();
    draft = on_grid(plan, false, divisions, may_refine_bores_ && plan.bounded && options_.hexes == 0);
    Routed routes = routed(draft, draft.complex);
    if (!levels_.empty() && !saves_cells(draft, routes.association)) {
      levels_.clear();
      draft = on_grid(plan, false, divisions);
      routes = routed(draft, draft.complex);
    }
    if (plan.bounded && levels_.empty()) own_.bounded_grids_.push_back(grid_of(draft));
    if (!routes.association.lost_edges.empty()) give_room(draft, routes, divisions);
    Association association = divided(draft, std::move(routes));
    if (!options_.coarsest && plan.structure.min_bend == 0 && own_.size_ > kSearchTuning.coarse * model_.diagonal()) {
      for (const double finer : kSearchTuning.finer) {
        if (association.lost_edges.empty()) break;
        if (finer <= plan.refine) continue;
        refine(draft, association, finer, divisions);
      }
    }
    round_out(draft, association, divisions);
    return association;
  }

  // CAD edges take other ways on the grid than their images do: those with too few mesh edges for their turning get more cells, as long as that helps.
  void round_out(Draft& draft, Association& association, const Divisions& divisions) {
    more_elements_.clear();
    const std::vector<RoundEdge> edges = before_levels(round_edges(model_, effective_per_circle(options_)), levels_);
    const auto missing = [&](const Association& a) { return missing_elements(edges, elements_on_edges(a, model_.edge_count())); };
    const auto sum = [](const std::vector<int>& v) { return std::accumulate(v.begin(), v.end(), 0); };
    std::vector<int> before = missing(association);
    for (int round = 0; round < kSearchTuning.rounding_rounds && sum(before) > 0; ++round) {
      for (std::size_t i = 0; i < edges.size(); ++i) {
        if (before[i] > 0) more_elements_[edges[i].edge] += before[i];
      }
      try {
        Draft next = on_grid(draft.plan, draft.roomy, divisions);
        Association found = divided(next, routed(next, next.complex));
        const std::vector<int> now = missing(found);
        if (found.lost_edges.size() > association.lost_edges.size() || sum(now) >= sum(before)) continue;
        before = now;
        draft = std::move(next);
        association = std::move(found);
      } catch (const StageFailed& e) {
        monitor_.log("with more elements round circles: " + e.stage() + ": " + e.what());
        break;
      }
    }
    more_elements_.clear();
  }

  // The draft on a finer grid, where that captures more CAD edges and is not too fine for any computer.
  void refine(Draft& draft, Association& association, double finer, const Divisions& divisions) {
    Plan refined = draft.plan;
    refined.refine = finer;
    try {
      Draft next = on_grid(refined, false, divisions);
      Association found = divided(next, routed(next, next.complex));
      if (found.lost_edges.size() >= association.lost_edges.size()) return;
      draft = std::move(next);
      association = std::move(found);
    } catch (const StageFailed& e) {
      monitor_.log("on a finer grid: " + e.stage() + ": " + e.what());
    } catch (const InvalidInput& e) {
      monitor_.log(std::string("on a finer grid: ") + e.what());
    }
  }

  // Edges may have found no path because too few cells are there for them.
  void give_room(Draft& draft, Routed& routes, const Divisions& divisions) {
    Draft next = on_grid(draft.plan, true, divisions);
    if (next.quantization.value == draft.quantization.value) return;
    Routed found = routed(next, next.complex);
    if (found.association.lost_edges.size() >= routes.association.lost_edges.size()) return;
    draft = std::move(next);
    routes = std::move(found);
  }

  // The plan up to its grid of hexahedra. `roomy`: cells enough for CAD edges that go on from each other inside a chart.
  // `refining`: bores may be left to local refinement, which is decided then.
  Draft on_grid(const Plan& plan, bool roomy, const Divisions& divisions, bool refining = false) {
    Draft draft;
    draft.plan = plan;
    draft.roomy = roomy;
    draft.structure = &own_.structures_.structure(plan.structure);
    const Structure& s = *draft.structure;
    draft.options.ignored = own_.ignored_;
    draft.options.edge_chains = edge_chains(model_, s.tets);
    const std::vector<char> out = own_.structures_.left_out(plan.structure);
    for (const int e : model_.edges()) {
      if (out[e] && !own_.ignored_[e]) draft.options.edge_chains[e].clear();
    }
    draft.quantization = clock_.stage("quantize", [&] {
      Quantization whole = quantized(plan, s, draft.options, roomy, divisions);
      whole_cells_ = refining ? cell_count(s.blocks, whole.value) : 0;
      if (whole_cells_ <= kSearchTuning.many_cells) return whole;
      const std::vector<RoundEdge> edges = round_edges(model_, effective_per_circle(options_));
      levels_ = levels_round_bores(edges);
      if (levels_.empty()) return whole;
      Quantization fewer = quantized(plan, s, draft.options, roomy, divisions);
      if (whole_cells_ > kSearchTuning.carried * cell_count(s.blocks, fewer.value)) return fewer;
      levels_.clear();
      return whole;
    });
    draft.levels = levels_;
    if (plan.bounded) check_time(plan, cell_count(s.blocks, draft.quantization.value));
    draft.complex = clock_.stage("hex", [&] {
      const std::vector<int>& value = draft.quantization.value;
      Spacing spacing = graded_spacing(s.blocks, s.map, value, options_.growth);
      if (!options_.bias.empty()) bias_edges(edge_chains(model_, s.tets), s.tets, s.map, s.blocks, options_.bias, value, spacing);
      return build_hexes(s.tets, s.map, s.blocks, draft.quantization, monitor_, spacing);
    });
    monitor_.log("hex: " + std::to_string(s.blocks.blocks.size()) + " blocks, " + std::to_string(draft.complex.mesh.hexes.size()) + " hexes");
    draft.options.size = typical_edge(draft.complex.mesh);
    return draft;
  }

  // Under a time limit, while there is no mesh, a grid that could not be fitted in the plan's time is not begun: there are plans with fewer cells.
  void check_time(const Plan& plan, double cells) {
    if (monitor_.deadline() == Monitor::Clock::time_point::max() || own_.gate_seconds_ > 0) return;
    const std::chrono::duration<double> left = monitor_.deadline() - Monitor::Clock::now();
    if (kSearchTuning.cell_seconds * cells <= left.count()) return;
    if (plan.refine == 1) own_.pressed_ = true;
    throw StageFailed("quantize", "a grid of " + std::to_string(std::lround(cells)) + " cells would take longer than its share of the time");
  }

  // Whether local refinement round bores takes far fewer cells than the grid of the whole part.
  bool saves_cells(const Draft& draft, const Association& association) const {
    const RefinePlan plan = bores_of(draft, association);
    if (plan.empty()) return false;
    const auto cells = static_cast<double>(count_refined(draft.complex.mesh, association, plan, 1, monitor_));
    const bool saves = cells < kSearchTuning.local_share * whole_cells_;
    monitor_.log("refine: " + std::to_string(plan.round.size()) + " bores by themselves would take about " + std::to_string(std::lround(cells)) +
                 " cells, the grid of the whole part " + std::to_string(std::lround(whole_cells_)) + (saves ? ": by themselves" : ": by the grid"));
    return saves;
  }

  RefinePlan bores_of(const Draft& draft, const Association& association) const {
    return plan_for_bores(round_edges(model_, effective_per_circle(options_)), draft.levels, association, model_.edge_count());
  }

  // All that is to be refined locally.
  RefinePlan places_of(const Draft& draft, const Association& association) const {
    RefinePlan plan = bores_of(draft, association);
    plan.everywhere = options_.refine;
    return plan;
  }

  Quantization quantized(const Plan& plan, const Structure& s, const AssociateOptions& association, bool roomy, const Divisions& divisions) const {
    const double scale = options_.coarsest ? kSearchTuning.coarsest : plan.refine / own_.size_;
    std::vector<DistanceConstraint> room = room_for_vertices(model_, s.tets, s.map, s.blocks, association.edge_chains, association.ignored);
    auto chains = association.edge_chains;
    for (const FeatureEdge& e : s.features.edges) {
      if (e.capture == EdgeCapture::kLost) chains[e.edge].clear();
    }
    if (roomy) {
      const auto more = room_for_edges(chains, s.tets, s.map, s.blocks);
      room.insert(room.end(), more.begin(), more.end());
    }
    MeshOptions demanded = options_;
    demanded.divisions = divisions;
    IntegerOptions wanted;
    wanted.scale = scale;
    wanted.wanted_cells = options_.hexes * std::pow(plan.refine, 3) * grid_share_;
    wanted.growth = options_.growth;
    wanted.growing = plan.bounded;
    wanted.coarsest = options_.coarsest;
    wanted.local = !levels_.empty();
    const bool places_matter = !demanded.divisions.empty() || !demanded.sizes.empty();
    const DemandPlaces places = places_matter ? find_places(model_, s.tets, s.map, s.blocks) : DemandPlaces();
    wanted.demanded = [&](double at) { return quantize_options(places, s.tets, s.map, s.blocks, demanded, at); };
    wanted.room = std::move(room);
    MeshOptions bounding = options_;
    if (!plan.layered) bounding.min_layers = std::max(1, options_.min_layers);
    if (plan.bounded) wanted.bounds = part_bounds(model_, s.tets, s.map, s.blocks, chains, bounding, more_elements_, levels_);
    Integers found = find_integers(s.blocks, s.map, wanted, monitor_);
    for (const std::string& line : found.deciding) monitor_.log("size: " + line);
    return std::move(found.quantization);
  }

  Routed routed(const Draft& draft, const HexComplex& complex) {
    Routed result;
    const HexBoundary boundary{complex.mesh.points, complex.quads, complex.quad_chart, complex.quad_triangle};
    result.association = clock_.stage(
        "pad", [&] { return associate(model_, draft.structure->tets, draft.structure->map.charts, boundary, draft.options, monitor_, &result.crowded); });
    return result;
  }

  // Where vertices lack mesh edges for their CAD edges the grid is divided there, as long as that captures more of them.
  Association divided(Draft& draft, Routed routes) {
    Association association = std::move(routes.association);
    HexComplex roomy = draft.complex;
    for (int round = 0; round < kSearchTuning.room_rounds && !routes.crowded.empty(); ++round) {
      int added = 0;
      for (const CrowdedCorner& c : routes.crowded) added += make_room(roomy.mesh, {roomy.quads, roomy.quad_chart, roomy.quad_triangle}, c);
      if (added == 0) break;
      monitor_.log("pad: room made at " + std::to_string(routes.crowded.size()) + " vertices");
      routes = routed(draft, roomy);
      if (routes.association.lost_edges.size() >= association.lost_edges.size()) continue;
      association = std::move(routes.association);
      draft.complex = roomy;
    }
    std::string lost;
    for (std::size_t i = 0; i < std::min<std::size_t>(association.lost_edges.size(), 8); ++i) lost += " " + name({1, association.lost_edges[i]});
    monitor_.log("pad: " + std::to_string(association.patches.size()) + " patches, " + std::to_string(association.lost_edges.size()) + " edges and " +
                 std::to_string(association.lost_vertices.size()) + " vertices without mesh" + (lost.empty() ? "" : ":" + lost));
    return association;
  }

  FitOptions fit_options() const {
    FitOptions result;
    result.threads = own_.threads_;
    result.hurry = own_.hurry_;
    return result;
  }

  static std::vector<FitCandidate> candidates_of(std::vector<PaddedMesh>& choices) {
    std::vector<FitCandidate> result;
    result.reserve(choices.size());
    for (PaddedMesh& c : choices) result.push_back({c.mesh, c.association});
    return result;
  }

  // Where all have about as many cells, the first will do.
  std::size_t promising(std::vector<PaddedMesh>& choices) {
    const auto [least, most] =
        std::minmax_element(choices.begin(), choices.end(), [](const PaddedMesh& a, const PaddedMesh& b) { return a.mesh.hexes.size() < b.mesh.hexes.size(); });
    if (static_cast<double>(most->mesh.hexes.size()) <= (1 + kSearchTuning.count_miss) * static_cast<double>(least->mesh.hexes.size())) return 0;
    return clock_.stage("fit", [&] { return most_promising(model_, candidates_of(choices), fit_options(), monitor_); });
  }

  // Rings alone take cells from the outside of a tube, of which nothing may be asked then.
  bool may_be_radial() const { return options_.divisions.empty() && options_.sizes.empty() && options_.max_size <= 0; }

  // With rings round bores and in cylinders; none where there is nothing to ring, or they would take divisions that are asked for.
  std::optional<PaddedMesh> with_rings(const PaddedMesh& mesh, const Draft& draft) const {
    if (options_.coarsest) return std::nullopt;
    RingOptions options{draft.complex.mesh.hexes.size(), may_be_radial(), kPipelineTuning.size_rounding * options_.size, {}};
    for (const auto& [edge, levels] : draft.levels) options.left_edges.push_back(edge);  // local refinement rings these
    return clock_.stage("pad", [&] {
      std::optional<PaddedMesh> ringed = mesh;
      const auto unmet = [&](const PaddedMesh& m) { return unmet_divisions(m.mesh, m.association, options_.divisions).size(); };
      try {
        if (insert_concentric(model_, *ringed, options, monitor_) == 0 || unmet(*ringed) > unmet(mesh)) ringed.reset();
      } catch (const StageFailed& e) {
        monitor_.log(e.stage() + ": without rings: " + e.what());
        ringed.reset();
      }
      return ringed;
    });
  }

  // The most promising with rings round bores if there are any and its cells are good with them, else the best of all without.
  FitChoice ring_and_fit(std::vector<PaddedMesh>& choices, const Draft& draft, bool& ringed) {
    const auto fit_all = [&](std::vector<PaddedMesh>& meshes) {
      const auto good = [&](std::size_t i, const FitReport& r) {
        return r.inverted == 0 && (good_cells(score_of(model_, r.min_scaled_jacobian, meshes[i])) || own_.hurry_());
      };
      FitChoice best = clock_.stage("fit", [&] { return fit_best(model_, candidates_of(meshes), fit_options(), fits_left_, good, monitor_); });
      fits_left_ -= best.fitted;
      return best;
    };
    std::size_t first = 0;
    std::optional<PaddedMesh> with = with_rings(choices[0], draft);
    if (with && choices.size() > 1) {
      std::vector<PaddedMesh> moved = choices;  // by the look at what comes of each
      first = clock_.stage("fit", [&] { return most_promising(model_, candidates_of(moved), fit_options(), monitor_); });
      if (first > 0) with = with_rings(choices[first], draft);
    }
    ringed = with.has_value();
    if (!ringed) return fit_all(choices);
    std::vector<PaddedMesh> rings{std::move(*with)};
    FitChoice best = fit_all(rings);
    const double enough = fit_options().target_scaled_jacobian - kSearchTuning.ring_loss;
    const int cut_offs = count_cut_offs(model_, rings[0]);
    const bool good =
        best.report.inverted == 0 && cut_offs == 0 && (best.report.min_scaled_jacobian >= enough || at_cad_bound(model_, rings[0].mesh, rings[0].association));
    if (!good && fits_left_ > 0) {
      FitChoice other = fit_all(choices);
      if (other.report.inverted < best.report.inverted || count_cut_offs(model_, choices[other.index]) < cut_offs ||
          (other.report.inverted == best.report.inverted && other.report.min_scaled_jacobian > best.report.min_scaled_jacobian + kSearchTuning.ring_loss)) {
        ringed = false;
        return other;
      }
    }
    choices[first] = std::move(rings[0]);
    best.index = first;
    return best;
  }

  // Pads by the plan that the draft chose before, or by the best of all.
  void pad_and_fit(Draft& draft, const Association& association) {
    std::vector<PadReport> pad_reports;
    std::vector<PaddedMesh> choices =
        clock_.stage("pad", [&] { return pad_choices(model_, draft.complex.mesh, association, monitor_, &pad_reports, {}, own_.threads_); });
    if (draft.choice >= 0 && choices.size() > 1) {
      const auto index = std::min(static_cast<std::size_t>(draft.choice), choices.size() - 1);
      choices = {std::move(choices[index])};
      pad_reports = {pad_reports[index]};
    }
    if (fits_left_ <= 0) throw StageFailed("fit", "cells stay inverted after " + std::to_string(fits_) + " attempts");
    bool ringed = false;
    FitChoice best = ring_and_fit(choices, draft, ringed);
    const std::size_t chosen = best.index;
    draft.fitted = best.report;
    draft.padded_hexes = static_cast<int>(choices[chosen].mesh.hexes.size() - draft.complex.mesh.hexes.size());
    monitor_.log("pad: " + std::to_string(draft.padded_hexes) + " hexes added, " + std::to_string(pad_reports[chosen].rings) + " rings at borders, " +
                 (ringed ? "" : "none ") + "round bores and in cylinders, choice " + std::to_string(chosen + 1) + " of " + std::to_string(choices.size()));
    monitor_.log("fit: min SJ " + std::to_string(draft.fitted.min_scaled_jacobian) + ", mean " + std::to_string(draft.fitted.mean_scaled_jacobian) + ", " +
                 std::to_string(draft.fitted.inverted) + " inverted");
    if (draft.choice < 0) draft.choice = static_cast<int>(chosen);
    draft.padded = std::move(choices[chosen]);
    draft.parent.clear();
    draft.refine_warnings.clear();
    if (draft.fitted.inverted == 0) refine_places(draft);
    for (const WorstCell& cell : worst_cells(draft.padded.mesh, draft.padded.association, 3)) {
      std::string line = "fit: cell at";
      for (double x : own_.pose_.back(cell.centre)) line += " " + std::to_string(x);
      line += " has SJ " + std::to_string(cell.scaled_jacobian);
      for (int f : cell.faces) line += " " + name({2, f});
      monitor_.log(line);
    }
  }

  // Locally, where the mesh of the whole part is good.
  void refine_places(Draft& draft) {
    const RefinePlan plan = places_of(draft, draft.padded.association);
    if (plan.empty()) return;
    LocallyRefined refined = clock_.stage("refine", [&] { return refine_locally(model_, draft.padded, plan, fit_options(), monitor_); });
    draft.unrefined = std::exchange(draft.padded, std::move(refined.padded));
    draft.parent = std::move(refined.parent);
    draft.refine_warnings = std::move(refined.warnings);
    draft.fitted = refined.fitted;
  }

  Evaluator& own_;
  const CadModel& model_;
  const MeshOptions& options_;
  const Monitor& monitor_;
  StageClock& clock_;
  const int fits_;
  int fits_left_;
  std::map<int, int> more_elements_;  // per round CAD edge, where a grid gave it fewer than it needs
  EdgeLevels levels_;                 // round bores that are left to local refinement
  bool may_refine_bores_ = true;
  double whole_cells_ = 0;  // of the grid that gives bores their elements without it
  double grid_share_ = 1;   // of the grid's cells among all, where a number of them is asked for
};

Evaluator::Evaluator(const Pose& pose, const MeshOptions& options, Structures& structures, StageClock& clock, const Monitor& monitor,
                     std::function<bool()> hurry)
    : pose_(pose),
      model_(pose.model),
      options_(options),
      monitor_(monitor),
      size_(wanted_size(options, model_)),
      ignored_(smooth_edges(model_, options.feature_angle * std::numbers::pi / 180, options.keep_faces)),
      threads_(thread_count(options.threads)),
      clock_(clock),
      structures_(structures),
      hurry_(std::move(hurry)) {}

Evaluator::~Evaluator() = default;

std::vector<LabelVariant> Evaluator::label_order() { return structures_.label_order(); }

Outcome Evaluator::evaluate(const Plan& plan, const Made* from, int fits) {
  if (plan.surrender != Surrender::kNothing) return Work(*this, fits).surrendered(static_cast<const Draft&>(*from), plan.surrender);
  Outcome skipped;
  skipped.kind = Outcome::Kind::kPostponed;
  if (plan.may_wait && structures_.doubtful(plan.structure)) return skipped;
  skipped.kind = Outcome::Kind::kDuplicate;
  if (structures_.repeats(plan.structure)) return skipped;
  Work work(*this, fits);
  if (plan.for_poor && work.repeats_grid(plan)) return skipped;
  return work.anew(plan);
}

int Evaluator::count(const Plan& plan) { return Work(*this, 0).count(plan); }

MeshResult Evaluator::result(const Outcome& outcome) const {
  const Draft& draft = draft_in(outcome);
  const Structure& s = *draft.structure;
  const Quantization& q = draft.quantization;
  MeshResult result;
  result.mesh = draft.padded.mesh;
  result.association = draft.padded.association;
  std::vector<int> blocks = draft.complex.hex_block;
  if (options_.coarsest) std::iota(blocks.begin(), blocks.end(), 0);
  const PaddedMesh& padded = draft.before_refining();
  if (!padded.origin.empty()) {
    std::vector<int> kept;
    for (const int origin : padded.origin) kept.push_back(blocks[origin]);
    blocks = std::move(kept);
  }
  result.hex_block = carry_blocks(padded.mesh, std::move(blocks));
  if (!draft.parent.empty()) {
    std::vector<int> of_parts;
    for (const int parent : draft.parent) of_parts.push_back(result.hex_block[parent]);
    result.hex_block = std::move(of_parts);
  }

  MeshReport& r = result.report;
  r.version = POLYCUBE_VERSION;
  r.size = size_;
  r.charts = static_cast<int>(s.map.charts.size());
  r.blocks = static_cast<int>(s.blocks.blocks.size());
  r.tets = static_cast<int>(s.tets.tets.size());
  r.quantization = {q.objective, q.bound, q.gap(), q.optimal, q.nodes, q.cuts, q.c2_rounds};
  r.padded_hexes = draft.padded_hexes;
  r.hexes = static_cast<int>(result.mesh.hexes.size());
  r.nodes = static_cast<int>(result.mesh.points.size());
  std::vector<int> real;
  for (const int e : model_.edges()) {
    if (!model_.edge(e).seam && !model_.edge(e).degenerate && !model_.edge(e).tiny) real.push_back(e);
  }
  r.capture = capture(result.association, static_cast<int>(model_.vertices().size()), real, static_cast<int>(model_.faces().size()));
  r.stages = clock_.records();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  r.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;

  if (!q.optimal) r.warnings.push_back("the sizes of the cells could be better still: the best integers were not found within the search's nodes");
  if (!draft.plan.bounded) r.warnings.push_back("the size alone decides: with the cells that walls and circles ask for the mesh would be poor or none");
  if (!draft.plan.layered) r.warnings.push_back("walls have fewer layers than the default: with them the mesh would be poor or none");
  if (draft.plan.refine != 1) r.warnings.push_back("the cells are finer than asked for");
  for (std::string& line : unmet_divisions(result.mesh, result.association, options_.divisions)) r.warnings.push_back(std::move(line));
  r.warnings.insert(r.warnings.end(), draft.refine_warnings.begin(), draft.refine_warnings.end());
  for (int e : result.association.lost_edges) r.warnings.push_back(name({1, e}) + " has no mesh edges on it");
  for (std::string& line : merged_faces(r.capture, result.association)) r.warnings.push_back(std::move(line));
  return result;
}

}  // namespace polycube
