#include "pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/hexahedron.h"
#include "pipeline/demands.h"
#include "pipeline/loose_nodes.h"
#include "pipeline/search/evaluator.h"
#include "pipeline/shortfalls.h"

namespace polycube {
namespace {

// Times the seconds that the gate took with the best mesh: what is kept of the time limit to hand it out. Elements of second order and the file took up to 16 times
// as long on the example parts.
constexpr double kFinishing = 20;

// Share of the time limit after which a search without a mesh looks for any (guess): the last ways take some fits too.
constexpr double kHurry = 0.5;

MeshResult search_mesh(const Pose& pose, const MeshOptions& options, const Monitor& monitor) {
  Monitor searching(monitor, monitor.deadline());
  Evaluator evaluator(pose, options, searching);
  const Budget budget = budget_of(options.effort);
  const auto evaluate = [&](const Plan& plan, const Made* from, int fits) {
    Outcome outcome = evaluator.evaluate(plan, from, fits);
    if (outcome.score && monitor.deadline() != Monitor::Clock::time_point::max()) {
      const std::chrono::duration<double> finishing(kFinishing * evaluator.gate_seconds());
      searching.set_deadline(monitor.deadline() - std::chrono::duration_cast<Monitor::Clock::duration>(finishing));
    }
    return outcome;
  };
  const Schedule schedule(keeping_plans(options, evaluator.label_order()), last_plans(), budget);
  const auto begun = Monitor::Clock::now();
  const auto hurry = [&] {
    const auto deadline = searching.deadline();
    return deadline != Monitor::Clock::time_point::max() && std::chrono::duration<double>(Monitor::Clock::now() - begun) > kHurry * std::chrono::duration<double>(deadline - begun);
  };
  const SearchResult found = search(schedule, budget, evaluate, searching, hurry);
  MeshResult result = evaluator.result(found.best);
  result.report.plan = found.plan.name;
  result.report.plans_tried = found.tried;
  result.report.out_of_time = found.out_of_time;
  if (found.out_of_time) result.report.warnings.push_back("the search was ended early; this is the best mesh so far");
  return result;
}

// What the user set by hand is the first thing to look at.
StageFailed with_labels(const StageFailed& failure, const FaceLabels& labels) {
  if (labels.empty()) return failure;
  std::string text = failure.what();
  for (const auto& [face, label] : labels) text += (&face == &labels.front().first ? ", with " : ", ") + name({2, face}) + "=" + label_name(label);
  return StageFailed(failure.stage(), text + " set by hand", failure.entities());
}

}  // namespace

MeshResult mesh(const CadModel& model, const MeshOptions& options, const Monitor& monitor) {
  check(options);
  check(options, model.diagonal(), model.faces(), model.edges());
  check_count(options.coarsest || options.hexes > 0 ? 0 : model.volume() / std::pow(effective_size(options, model.diagonal()), 3));
  check_divisions(model, options.divisions);
  const Pose pose = canonical_pose(model, options.frame);
  MeshResult result = [&] {
    try {
      return search_mesh(pose, pose.posed(options), monitor);
    } catch (const StageFailed& e) {
      throw with_labels(e, options.labels);
    }
  }();
  // A mesh that is there is handed out, late or not.
  const Monitor finishing(monitor, result.report.out_of_time ? Monitor::Clock::time_point::max() : monitor.deadline());
  restore(pose, model, result.association, result.mesh, finishing);
  const QualitySummary quality = summarise(result.mesh);
  if (!(quality.min_scaled_jacobian > 0)) throw StageFailed("fit", "cells lose their volume on the way back to the part's place");
  MeshReport& r = result.report;
  r.options = options;
  r.warnings.insert(r.warnings.begin(), model.warnings().begin(), model.warnings().end());
  r.size /= pose.scale;
  r.quality = quality;
  r.shape = summarise_shape(result.mesh);
  r.volume = 0;
  for (const Hex& h : result.mesh.hexes) r.volume += hex_volume(result.mesh.points, h);
  r.cad_volume = model.volume();
  r.worst = worst_cells(result.mesh, result.association);
  const Shortfalls short_of = find_shortfalls(model, result.mesh, result.association, effective_min_layers(options), effective_per_circle(options));
  r.thin_walls = static_cast<int>(short_of.thin_walls.size());
  r.coarse_circles = static_cast<int>(short_of.coarse_circles.size());
  for (const auto* lines : {&short_of.thin_walls, &short_of.coarse_circles}) r.warnings.insert(r.warnings.end(), lines->begin(), lines->end());
  r.loose_nodes = count_loose_nodes(model, result.association, result.mesh.points);
  return result;
}

}  // namespace polycube
