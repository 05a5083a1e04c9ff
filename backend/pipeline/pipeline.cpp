#include "pipeline/pipeline.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "core/hexahedron.h"
#include "fem/fem.h"
#include "fit/fit.h"
#include "hex/hex.h"
#include "pad/associate.h"
#include "pad/pad.h"
#include "pipeline/block_ids.h"
#include "pipeline/demands.h"
#include "pipeline/edge_runs.h"
#include "pipeline/loose_nodes.h"
#include "pipeline/structures.h"
#include "pipeline/vertex_room.h"
#include "quantize/quantize.h"

namespace polycube {
namespace {

// Ways to label the part that are tried on one grid.
constexpr std::size_t kLabellings = 4;
// Those that are tried on other grids before the rest is tried on one.
constexpr std::size_t kBestLabellings = 2;
// Good enough to stop looking for a better candidate.
constexpr double kGoodScaledJacobian = 0.2;
// CAD edges whose faces meet within 30 degrees of smooth are given up first.
constexpr double kSmoothBend = std::numbers::pi / 6;
// Times that edges are given up for one candidate.
constexpr int kRelaxRounds = 5;
// Fits in one run, over all candidates: what has not come out by then will not, and the user waits.
constexpr int kMaxFits = 10;
// Fits after which a complete mesh with poor cells is good enough.
constexpr int kPatience = 6;
// Those kept back for giving up edges, while there is no mesh at all.
constexpr int kReservedFits = 5;
// Of the diagonal: below this a mesh edge is none.
constexpr double kShortestEdge = 1e-8;
// A bend that no CAD edge reaches, radians.
constexpr double kNoEdge = 4;
// A size above this share of the diagonal may be too coarse for the edges of the part: then the first of these factors on the number of cells
// along an edge counts with which every CAD edge finds its path.
constexpr double kCoarse = 1.0 / 25;
constexpr std::array kFiner{1.25, 1.6, 2.0};
// Divisions of the grid one after the other at one vertex: for as many CAD edges more than a corner of the grid has.
constexpr int kRoomRounds = 3;
// The last candidates may always try this often.
constexpr int kLastFits = 4;
// eta of section 6.2 for the coarsest mesh.
constexpr double kCoarsest = 1e-6;

/// One way through the stages after tet; the pipeline tries them in order.
struct Candidate {
  std::string name;
  StructurePlan plan;         // CAD edges that it does without get no path either
  double refine = 1;          // on the number of cells along an edge
  bool roomy = false;         // cells enough for CAD edges that go on from each other inside a chart
};

/// Those that keep every CAD edge. `labels`: the ways to label the part, best first.
std::vector<Candidate> candidates(const MeshOptions& options, std::vector<LabelVariant> labels) {
  labels.resize(std::min(labels.size(), kLabellings));
  std::vector<Candidate> list;
  const auto add = [&](const std::string& what, std::size_t first, std::size_t end, double refine, double tet_size) {
    for (std::size_t i = first; i < std::min(end, labels.size()); ++i) {
      list.push_back({"all CAD edges" + what + (i > 0 ? ", labels " + std::to_string(i + 1) : ""), {.labels = labels[i], .tet_size = tet_size}, refine});
    }
  };
  add("", 0, kBestLabellings, 1, 1);
  // Whether a thin strip gets one cell or two can decide over the whole mesh.
  if (!options.coarsest) add(", finer", 0, kBestLabellings, 1.25, 1);
  add("", kBestLabellings, kLabellings, 1, 1);
  // Another tet mesh gives a slightly other map, and with it other strips.
  add(", other tets", 0, kBestLabellings, 1, 0.8);
  return list;
}

/// Better than nothing, for a look at volumes and modes.
std::vector<Candidate> last_candidates() {
  return {{"sharp CAD edges, no feature charts", {.min_bend = std::numbers::pi / 18, .features = false}},
          {"no CAD edges", {.min_bend = kNoEdge, .features = false}},
          {"no CAD edges, other tets", {.min_bend = kNoEdge, .features = false, .tet_size = 0.8}}};
}

/// A candidate whose fit left inverted cells.
struct Unfinished {
  Candidate candidate;
  const Structure* structure = nullptr;
  HexComplex complex;
  Quantization quantization;
  AssociateOptions options;
  PaddedMesh padded;
  int choice = -1;  // of the padding plans
  FitReport fitted;
  MeshReport report;
};

/// CAD edges on a grid, and where they lack room.
struct Routed {
  Association association;
  std::vector<CrowdedCorner> crowded;
};

class Run {
 public:
  /// Works in the pose; `options` are those of the pose too.
  Run(const Pose& pose, const MeshOptions& options, const Monitor& monitor)
      : pose_(pose),
        model_(pose.model),
        options_(options),
        monitor_(monitor),
        size_(options.hexes > 0 ? std::cbrt(model_.volume() / options.hexes) : effective_size(options, model_.diagonal())),
        ignored_(smooth_edges(model_, options.feature_angle * std::numbers::pi / 180, options.keep_faces)),
        clock_(monitor),
        structures_(pose, options, size_, ignored_, clock_, monitor) {
    report_.version = POLYCUBE_VERSION;
    report_.options = options;
    report_.size = size_;
    report_.cad_volume = model_.volume();
  }

  MeshResult run() {
    std::optional<MeshResult> best;
    std::optional<StageFailed> failure;
    // True when the search may end.
    const auto attempt_with = [&](const std::string& name, const auto& work) {
      try {
        MeshResult result = work();
        if (!best || rank(result) > rank(*best)) best = std::move(result);
      } catch (const StageFailed& e) {
        monitor_.log("candidate '" + name + "' failed in " + e.stage() + ": " + e.what());
        if (!failure) failure = e;
        if (e.stage() == "tet" && !best) throw;  // every setting was tried: the other candidates have no other tets
      }
      return best && good_enough(*best);
    };
    std::vector<Candidate> list = candidates(options_, structures_.label_order());
    const std::size_t listed = list.size();
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (fits_left_ <= (best ? kReservedFits / 2 : kReservedFits)) break;
      const Candidate c = list[i];
      if (i < listed && structures_.doubtful(c.plan)) {
        list.push_back(c);
        continue;
      }
      const auto work = [&] {
        MeshResult result = attempt(c, !best && !failure, options_.divisions);
        retry_padded(c, result);
        return result;
      };
      if (attempt_with(c.name, work)) break;
    }
    // CAD edges are given up only where nothing else came out, and first where least is wrong.
    std::stable_sort(unfinished_.begin(), unfinished_.end(), [](const Unfinished& a, const Unfinished& b) {
      const auto fault = [](const Unfinished& u) { return u.fitted.inverted + u.padded.association.lost_edges.size(); };
      return fault(a) < fault(b);
    });
    for (Unfinished& u : unfinished_) {
      if (best || fits_left_ <= 0) break;
      attempt_with(u.candidate.name + " but where cells stay inverted", [&] { return relax(u); });
    }
    // Not one by one any more, but all that is near.
    if (!best && !unfinished_.empty()) {
      fits_left_ = kLastFits;
      attempt_with(unfinished_.front().candidate.name + " but round cells that stay inverted", [&] { return relax_around(unfinished_.front()); });
    }
    for (const Candidate& c : last_candidates()) {
      if (best) break;
      unfinished_.clear();
      fits_left_ = kLastFits;
      attempt_with(c.name, [&] { return attempt(c, false, options_.divisions); });
      if (!best && !unfinished_.empty()) attempt_with(c.name, [&] { return relax(unfinished_.front()); });
    }
    if (!best) throw failure ? *failure : StageFailed("pipeline", "no candidate left");
    best->report.stages = clock_.records();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    best->report.peak_memory_mb = static_cast<double>(usage.ru_maxrss) / 1024;
    return std::move(*best);
  }

 private:
  static bool complete(const MeshResult& r) { return r.association.lost_edges.empty() && r.association.lost_vertices.empty(); }
  // A mesh with poor cells is taken only when some others were no better.
  bool good_enough(const MeshResult& r) const {
    const double enough = fits_left_ > kMaxFits - kPatience ? kGoodScaledJacobian : kGoodScaledJacobian / 2;
    const double least = r.report.quality.min_scaled_jacobian;
    return complete(r) && (least >= enough || good_cells(least, r));
  }
  // Cells in a narrow corner of the CAD are what they are; another candidate would have the same.
  template <class Mesh>
  static bool good_cells(double least, const Mesh& m) {
    return least >= kGoodScaledJacobian || (least >= kGoodScaledJacobian / 2 && free_scaled_jacobian(m.mesh, m.association) >= kGoodScaledJacobian);
  }
  // More captured edges first, then the better worst cell.
  static std::pair<double, double> rank(const MeshResult& r) {
    const double quality = r.report.quality.min_scaled_jacobian;
    return {-static_cast<double>(r.association.lost_edges.size()) + 0.5 * (quality > 0.05), quality};
  }

  // Padding can add cells to a division that has a maximum: fewer are asked for then.
  void retry_padded(const Candidate& c, MeshResult& result) {
    const auto unmet = [&](const MeshResult& r) { return unmet_divisions(r.mesh, r.association, options_.divisions).size(); };
    const Divisions fewer = allow_for_padding(result.mesh, result.association, options_.divisions);
    if (fewer == options_.divisions) return;
    try {
      MeshResult again = attempt(c, false, fewer);
      if (unmet(again) < unmet(result)) result = std::move(again);
    } catch (const StageFailed& e) {
      monitor_.log("with fewer divisions: " + e.stage() + ": " + e.what());
    } catch (const InvalidInput& e) {
      monitor_.log(std::string("with fewer divisions: ") + e.what());
    }
  }

  MeshResult attempt(const Candidate& c, bool first, const Divisions& divisions) {
    Unfinished u = on_grid(c, first, divisions);
    Routed routes = routed(u, u.complex);
    if (!routes.association.lost_edges.empty()) give_room(u, routes, divisions);
    Association association = divided(u, std::move(routes));
    if (!options_.coarsest && c.plan.min_bend == 0 && size_ > kCoarse * model_.diagonal()) {
      for (const double finer : kFiner) {
        if (association.lost_edges.empty()) break;
        if (finer <= c.refine) continue;
        Candidate refined = u.candidate;
        refined.refine = finer;
        Unfinished next = on_grid(refined, false, divisions);
        Association found = associated(next);
        if (found.lost_edges.size() >= association.lost_edges.size()) continue;
        u = std::move(next);
        association = std::move(found);
      }
    }
    pad_and_fit(u, association);
    if (u.fitted.inverted > 0) {
      unfinished_.push_back(std::move(u));
      throw inverted(unfinished_.back());
    }
    return finished(std::move(u));
  }

  // Edges may have found no path because too few cells are there for them.
  void give_room(Unfinished& u, Routed& routes, const Divisions& divisions) {
    Candidate roomy = u.candidate;
    roomy.roomy = true;
    Unfinished next = on_grid(roomy, false, divisions);
    if (next.quantization.value == u.quantization.value) return;
    Routed found = routed(next, next.complex);
    if (found.association.lost_edges.size() >= routes.association.lost_edges.size()) return;
    u = std::move(next);
    routes = std::move(found);
  }

  // The candidate up to its grid of hexahedra.
  Unfinished on_grid(const Candidate& c, bool first, const Divisions& divisions) {
    Unfinished u;
    u.candidate = c;
    u.report = report_;
    u.structure = &structures_.structure(c.plan);
    const Structure& s = *u.structure;
    u.options.ignored = ignored_;
    u.options.edge_chains = edge_chains(model_, s.tets);
    const std::vector<char> out = structures_.left_out(c.plan);
    for (const FeatureEdge& e : s.features.edges) {
      if (out[e.edge]) {
        if (!ignored_[e.edge]) u.options.edge_chains[e.edge].clear();
      } else if (e.capture == EdgeCapture::kLost && first) {
        monitor_.log("label: " + name({1, e.edge}) + " has no feature chart: " + e.reason);
      }
    }
    u.quantization = clock_.stage("quantize", [&] { return quantized(c, s, u.options, divisions); });
    u.complex = clock_.stage("hex", [&] { return build_hexes(s.tets, s.map, s.blocks, u.quantization, monitor_); });
    monitor_.log("hex: " + std::to_string(s.blocks.blocks.size()) + " blocks, " + std::to_string(u.complex.mesh.hexes.size()) + " hexes");
    u.options.size = typical_edge(u.complex.mesh);
    return u;
  }

  Quantization quantized(const Candidate& c, const Structure& s, const AssociateOptions& association, const Divisions& divisions) const {
    const double scale = options_.coarsest ? kCoarsest : c.refine / size_;
    MeshOptions demanded = options_;
    demanded.divisions = divisions;
    const QuantizeOptions asked = quantize_options(model_, s.tets, s.map, s.blocks, demanded, scale);
    QuantizeOptions roomy = asked;
    auto room = room_for_vertices(model_, s.tets, s.map, s.blocks, association.edge_chains, association.ignored);
    if (c.roomy) {
      auto chains = association.edge_chains;
      for (const FeatureEdge& e : s.features.edges) {
        if (e.capture == EdgeCapture::kLost) chains[e.edge].clear();
      }
      const auto more = room_for_edges(chains, s.tets, s.map, s.blocks);
      room.insert(room.end(), more.begin(), more.end());
    }
    roomy.constraints.insert(roomy.constraints.end(), room.begin(), room.end());
    try {
      return quantize(s.blocks, s.map, roomy, monitor_);
    } catch (const InvalidInput&) {
      if (room.empty()) throw;
      return quantize(s.blocks, s.map, asked, monitor_);  // what the user demands comes first
    }
  }

  // A mesh that misses an edge is worth more than none: those that inverted cells stand on are given up, smooth ones first.
  MeshResult relax(Unfinished& u) {
    for (int round = 0; round < kRelaxRounds; ++round) {
      const int count = 1 << round;  // more and more of them, to come to an end
      const auto drop = [&](double limit, bool kept_too) { return give_up(u.padded, limit, kept_too, count, u.options); };
      if (!drop(kSmoothBend, false) && !drop(std::numbers::pi, false) && !drop(kNoEdge, true)) break;
      pad_and_fit(u, associated(u));
      if (u.fitted.inverted == 0) return finished(std::move(u));
    }
    throw inverted(u);
  }

  // The same with all edges within more and more cells of those that are inverted.
  MeshResult relax_around(Unfinished& u) {
    for (int rings = 0; rings < kLastFits && u.fitted.inverted > 0; ++rings) {
      give_up_around(u.padded, rings, u.options);
      pad_and_fit(u, associated(u));
    }
    if (u.fitted.inverted > 0) throw inverted(u);
    return finished(std::move(u));
  }

  void give_up_around(const PaddedMesh& padded, int rings, AssociateOptions& options) const {
    std::vector<char> near(padded.mesh.points.size(), 0);
    const auto reach = [&](const auto& which) {
      std::vector<int> nodes;
      for (const Hex& h : padded.mesh.hexes) {
        if (which(h)) nodes.insert(nodes.end(), h.begin(), h.end());
      }
      for (int n : nodes) near[n] = 1;
    };
    reach([&](const Hex& h) { return !(scaled_jacobian(padded.mesh.points, h) > 0); });
    for (int ring = 0; ring < rings; ++ring) reach([&](const Hex& h) { return std::any_of(h.begin(), h.end(), [&](int n) { return near[n] != 0; }); });
    for (std::size_t i = 0; i < padded.association.segments.size(); ++i) {
      const int edge = padded.association.segment_edge[i];
      const auto& [a, b] = padded.association.segments[i];
      if ((!near[a] && !near[b]) || options.edge_chains[edge].empty()) continue;
      options.edge_chains[edge].clear();
      monitor_.log("pad: " + name({1, edge}) + " is given up");
    }
  }

  static StageFailed inverted(const Unfinished& u) {
    std::vector<CadRef> faces;
    for (int f : u.fitted.bad_faces) faces.push_back({2, f});
    return StageFailed("fit", std::to_string(u.fitted.inverted) + " cells stay inverted", faces);
  }

  MeshResult finished(Unfinished u) {
    gate(u.padded);
    MeshResult result;
    result.report = std::move(u.report);
    const Structure& s = *u.structure;
    result.report.charts = static_cast<int>(s.map.charts.size());
    result.report.blocks = static_cast<int>(s.blocks.blocks.size());
    const Quantization& q = u.quantization;
    result.report.quantization = {q.objective, q.bound, q.gap(), q.optimal, q.nodes, q.cuts, q.c2_rounds};
    if (!q.optimal) result.report.warnings.push_back("the sizes of the cells could be better still: the best integers were not found within the search's nodes");
    result.report.tets = static_cast<int>(s.tets.tets.size());
    if (u.candidate.refine != 1) result.report.warnings.push_back("the cells are finer than asked for");
    std::vector<int> blocks = u.complex.hex_block;
    if (options_.coarsest) std::iota(blocks.begin(), blocks.end(), 0);
    result.hex_block = carry_blocks(u.padded.mesh, std::move(blocks));
    finish(result, std::move(u.padded));
    return result;
  }

  Association associated(Unfinished& u) { return divided(u, routed(u, u.complex)); }

  Routed routed(const Unfinished& u, const HexComplex& complex) {
    Routed result;
    const HexBoundary boundary{complex.mesh.points, complex.quads, complex.quad_chart, complex.quad_triangle};
    result.association =
        clock_.stage("pad", [&] { return associate(model_, u.structure->tets, u.structure->map.charts, boundary, u.options, monitor_, &result.crowded); });
    return result;
  }

  // Where vertices lack mesh edges for their CAD edges the grid is divided there, as long as that captures more of them.
  Association divided(Unfinished& u, Routed routes) {
    Association association = std::move(routes.association);
    HexComplex roomy = u.complex;
    for (int round = 0; round < kRoomRounds && !routes.crowded.empty(); ++round) {
      int added = 0;
      for (const CrowdedCorner& c : routes.crowded) added += make_room(roomy.mesh, {roomy.quads, roomy.quad_chart, roomy.quad_triangle}, c);
      if (added == 0) break;
      monitor_.log("pad: room made at " + std::to_string(routes.crowded.size()) + " vertices");
      routes = routed(u, roomy);
      if (routes.association.lost_edges.size() >= association.lost_edges.size()) continue;
      association = std::move(routes.association);
      u.complex = roomy;
    }
    monitor_.log("pad: " + std::to_string(association.patches.size()) + " patches, " + std::to_string(association.lost_edges.size()) + " edges and " +
                 std::to_string(association.lost_vertices.size()) + " vertices without mesh");
    return association;
  }

  void pad_and_fit(Unfinished& u, const Association& association) {
    u.padded = pad_and_fit(u.complex.mesh, association, u.choice, u.fitted, u.report);
    for (const WorstCell& cell : worst_cells(u.padded.mesh, u.padded.association, 3)) {
      std::string line = "fit: cell at";
      for (double x : pose_.back(cell.centre)) line += " " + std::to_string(x);
      line += " has SJ " + std::to_string(cell.scaled_jacobian);
      for (int f : cell.faces) line += " " + name({2, f});
      monitor_.log(line);
    }
  }

  bool on_kept_face(int edge) const {
    const auto& [a, b] = model_.edge(edge).faces;
    return std::any_of(options_.keep_faces.begin(), options_.keep_faces.end(), [&](int f) { return f == a || f == b; });
  }

  // Drops the `count` CAD edges that most nodes of inverted cells stand on, of those that bend less than `limit` (and are on faces to keep
  // only if `kept_too`). False if there is none.
  bool give_up(const PaddedMesh& padded, double limit, bool kept_too, int count, AssociateOptions& options) const {
    std::vector<std::set<int>> edges_at(padded.mesh.points.size());
    for (std::size_t i = 0; i < padded.association.segments.size(); ++i) {
      for (int n : padded.association.segments[i]) edges_at[n].insert(padded.association.segment_edge[i]);
    }
    std::map<int, int> blame;
    for (const Hex& h : padded.mesh.hexes) {
      if (scaled_jacobian(padded.mesh.points, h) > 0) continue;
      for (int n : h) {
        for (int e : edges_at[n]) {
          if (!options.edge_chains[e].empty() && bend(model_.edge(e)) < limit && (kept_too || !on_kept_face(e))) ++blame[e];
        }
      }
    }
    if (blame.empty()) return false;
    std::vector<std::pair<int, int>> worst;  // (minus blame, edge)
    for (const auto& [edge, nodes] : blame) worst.emplace_back(-nodes, edge);
    std::sort(worst.begin(), worst.end());
    for (int i = 0; i < std::min(count, static_cast<int>(worst.size())); ++i) {
      options.edge_chains[worst[i].second].clear();
      monitor_.log("pad: " + name({1, worst[i].second}) + " is given up");
    }
    return true;
  }

  // `choice`: the padding plan to fit, -1 for the best of all; on return the one chosen.
  PaddedMesh pad_and_fit(const HexMesh& mesh, const Association& association, int& choice, FitReport& fitted, MeshReport& report) {
    std::vector<PadReport> pad_reports;
    std::vector<PaddedMesh> choices = clock_.stage("pad", [&] { return pad_choices(model_, mesh, association, monitor_, &pad_reports); });
    if (choice >= 0 && choices.size() > 1) {
      const auto index = std::min(static_cast<std::size_t>(choice), choices.size() - 1);
      choices = {std::move(choices[index])};
      pad_reports = {pad_reports[index]};
    }
    FitOptions fit_options;
    if (options_.threads > 0) fit_options.threads = options_.threads;
    if (fits_left_ <= 0) throw StageFailed("fit", "cells stay inverted after " + std::to_string(kMaxFits) + " attempts");
    std::vector<FitCandidate> candidates;
    for (PaddedMesh& c : choices) candidates.push_back({c.mesh, c.association});
    const auto good = [&](std::size_t i, const FitReport& r) { return r.inverted == 0 && good_cells(r.min_scaled_jacobian, choices[i]); };
    const FitChoice best = clock_.stage("fit", [&] { return fit_best(model_, candidates, fit_options, fits_left_, good, monitor_); });
    const std::size_t chosen = best.index;
    fitted = best.report;
    fits_left_ -= best.fitted;
    report.padded_hexes = pad_reports[chosen].added_hexes;
    monitor_.log("pad: " + std::to_string(pad_reports[chosen].added_hexes) + " hexes added, " + std::to_string(pad_reports[chosen].rings) +
                 " rings, choice " + std::to_string(chosen + 1) + " of " + std::to_string(choices.size()));
    monitor_.log("fit: min SJ " + std::to_string(fitted.min_scaled_jacobian) + ", mean " + std::to_string(fitted.mean_scaled_jacobian) + ", " +
                 std::to_string(fitted.inverted) + " inverted");
    if (choice < 0) choice = static_cast<int>(chosen);
    return std::move(choices[chosen]);
  }

  static double typical_edge(const HexMesh& mesh) {
    double sum = 0;
    for (const Hex& h : mesh.hexes) {
      sum += (mesh.points[h[0]] - mesh.points[h[1]]).norm() + (mesh.points[h[0]] - mesh.points[h[3]]).norm() + (mesh.points[h[0]] - mesh.points[h[4]]).norm();
    }
    return sum / (3.0 * static_cast<double>(mesh.hexes.size()));
  }

  // Nothing passes that is not a conforming mesh of positive cells with the surface of the solid.
  void gate(const PaddedMesh& padded) const {
    const QualitySummary q = summarise(padded.mesh);
    if (padded.mesh.hexes.empty() || q.inverted > 0 || !(q.min_scaled_jacobian > 0)) throw StageFailed("fit", "cells without positive Jacobian");
    // CAD vertices that all but coincide cannot each have a node of its own.
    for (const Hex& h : padded.mesh.hexes) {
      for (const auto& [c, d] : kHexEdges) {
        if ((padded.mesh.points[h[c]] - padded.mesh.points[h[d]]).norm() > kShortestEdge * model_.diagonal()) continue;
        const CadRef at = padded.association.point_cad[h[c]];
        throw StageFailed("fit", "a cell without size", at.dim < 2 ? std::vector{at} : std::vector<CadRef>{});
      }
    }
    const std::vector<std::string> faults = check(padded.mesh, padded.association);
    if (!faults.empty()) throw StageFailed("pad", "the mesh does not conform: " + faults.front());
    std::set<int> nodes;
    std::set<std::pair<int, int>> edges;
    for (const Quad& quad : padded.association.quads) {
      for (int k = 0; k < 4; ++k) {
        nodes.insert(quad[k]);
        edges.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
      }
    }
    const int euler = static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + static_cast<int>(padded.association.quads.size());
    if (euler != model_.euler_characteristic()) throw StageFailed("hex", "the mesh has another topology than the solid");
    // Solvers look at integration points too; an element that cannot be made there is no better than an inverted one.
    build_fem_mesh(model_, padded.mesh, padded.association, {options_.order, options_.threads}, monitor_);
  }

  void finish(MeshResult& result, PaddedMesh padded) const {
    result.mesh = std::move(padded.mesh);
    result.association = std::move(padded.association);
    MeshReport& r = result.report;
    r.hexes = static_cast<int>(result.mesh.hexes.size());
    r.nodes = static_cast<int>(result.mesh.points.size());
    r.quality = summarise(result.mesh);
    for (const Hex& h : result.mesh.hexes) r.volume += hex_volume(result.mesh.points, h);
    r.worst = worst_cells(result.mesh, result.association);
    std::vector<int> real;
    for (int e = 1; e <= model_.edge_count(); ++e) {
      if (!model_.edge(e).seam && !model_.edge(e).degenerate && !model_.edge(e).tiny) real.push_back(e);
    }
    r.capture = capture(result.association, model_.vertex_count(), real, model_.face_count());
    for (std::string& line : unmet_divisions(result.mesh, result.association, options_.divisions)) r.warnings.push_back(std::move(line));
    for (int e : result.association.lost_edges) r.warnings.push_back(name({1, e}) + " has no mesh edges on it");
  }

  const Pose& pose_;
  const CadModel& model_;
  const MeshOptions& options_;
  const Monitor& monitor_;
  double size_;
  std::vector<char> ignored_;  // per CAD edge: the user does without it
  StageClock clock_;
  Structures structures_;
  int fits_left_ = kMaxFits;
  std::vector<Unfinished> unfinished_;
  MeshReport report_;
};

}  // namespace

MeshResult mesh(const CadModel& model, const MeshOptions& options, const Monitor& monitor) {
  check(options);
  check(options, model.diagonal(), model.face_count(), model.edge_count());
  check_count(options.coarsest || options.hexes > 0 ? 0 : model.volume() / std::pow(effective_size(options, model.diagonal()), 3));
  check_divisions(model, options.divisions);
  const Pose pose = canonical_pose(model, options.frame);
  const MeshOptions posed = pose.posed(options);
  MeshResult result = [&] {
    try {
      return Run(pose, posed, monitor).run();
    } catch (const StageFailed& e) {
      if (options.labels.empty()) throw;
      // What the user set is the first thing to look at.
      std::string text = e.what();
      for (const auto& [face, label] : options.labels) text += (&face == &options.labels.front().first ? ", with " : ", ") + name({2, face}) + "=" + label_name(label);
      throw StageFailed(e.stage(), text + " set by hand", e.entities());
    }
  }();
  restore(pose, model, result.association, result.mesh, monitor);
  const QualitySummary quality = summarise(result.mesh);
  if (!(quality.min_scaled_jacobian > 0)) throw StageFailed("fit", "cells lose their volume on the way back to the part's place");
  MeshReport& r = result.report;
  r.options = options;
  r.size /= pose.scale;
  r.quality = quality;
  r.shape = summarise_shape(result.mesh);
  r.volume = 0;
  for (const Hex& h : result.mesh.hexes) r.volume += hex_volume(result.mesh.points, h);
  r.cad_volume = model.volume();
  r.worst = worst_cells(result.mesh, result.association);
  r.loose_nodes = count_loose_nodes(model, result.association, result.mesh.points);
  return result;
}

}  // namespace polycube
