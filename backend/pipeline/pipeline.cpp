#include "pipeline/pipeline.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/hexahedron.h"
#include "pipeline/demands.h"
#include "pipeline/loose_nodes.h"
#include "pipeline/search/evaluator.h"
#include "pipeline/session.h"
#include "pipeline/shortfalls.h"
#include "pipeline/solids.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

// What a plan fails by that was cut short.
const std::string kNoTime = "its share of the time was over";

MeshResult search_mesh(const Pose& pose, const MeshOptions& options, Structures& structures, StageClock& clock, Monitor& searching, const Monitor& monitor) {
  const auto begun = Monitor::Clock::now();
  const auto hurry = [&, begun] {
    const auto deadline = monitor.deadline();
    return deadline != Monitor::Clock::time_point::max() &&
           std::chrono::duration<double>(Monitor::Clock::now() - begun) > kPipelineTuning.hurry * std::chrono::duration<double>(deadline - begun);
  };
  Evaluator evaluator(pose, options, structures, clock, searching, hurry);
  const Budget budget = budget_of(options.effort);
  bool mesh = false;
  const auto evaluate = [&](const Plan& plan, const Made* from, int fits) {
    if (!mesh) searching.set_deadline(deadline_of_plan(Monitor::Clock::now(), monitor.deadline()));
    Outcome outcome;
    try {
      outcome = evaluator.evaluate(plan, from, fits);
    } catch (const OutOfTime&) {
      if (mesh || Monitor::Clock::now() >= monitor.deadline()) throw;
      outcome.failure = Failure{StageFailed("fit", kNoTime), {}};
    }
    if (outcome.score && monitor.deadline() != Monitor::Clock::time_point::max()) {
      mesh = true;
      const std::chrono::duration<double> finishing(kPipelineTuning.finishing * evaluator.gate_seconds());
      searching.set_deadline(monitor.deadline() - std::chrono::duration_cast<Monitor::Clock::duration>(finishing));
    }
    return outcome;
  };
  const Schedule schedule(keeping_plans(options, evaluator.label_order()), last_plans(), budget);
  const SearchResult found = [&] {
    try {
      return search(schedule, budget, evaluate, searching, [&] { return hurry() || evaluator.pressed(); });
    } catch (const StageFailed& e) {
      if (e.what() == kNoTime) throw OutOfTime("out of time");
      throw;
    }
  }();
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

/// Checked options, those of the solid as those of all there is.
MeshOptions checked(const CadModel& model, const MeshOptions& given) {
  check(given, model.diagonal(), {model.faces(), model.edges(), model.vertices()});
  MeshOptions options = without_solids(given);
  check_count(options.coarsest || options.hexes > 0 ? 0 : model.volume() / std::pow(effective_size(options, model.diagonal()), 3));
  check_divisions(model, options.divisions);
  check_biases(model, options.bias);
  check_refinements(model, options.refine);
  return options;
}

// The first few of many; the report has their number.
void warn_of(const std::vector<std::string>& lines, const std::string& what, std::vector<std::string>& warnings) {
  constexpr std::size_t kTold = 4;  // what one reads at a glance
  const std::size_t told = lines.size() > kTold + 1 ? kTold : lines.size();
  warnings.insert(warnings.end(), lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(told));
  if (told < lines.size()) warnings.push_back(std::to_string(lines.size() - told) + " more " + what);
}

}  // namespace

/// The part in its pose, and its tets; they report to `monitor`, which follows that of each call.
struct Session::Posed {
  Posed(const CadModel& model, const MeshOptions& given)
      : frame(given.frame), pose(canonical_pose(model, frame)), tets(pose.model, wanted_size(pose.posed(given), pose.model), clock, monitor) {}
  FrameAxes frame;
  Pose pose;
  Monitor monitor;
  StageClock clock{monitor};
  TetMeshes tets;
};

/// Its structures.
struct Session::Prepared {
  Prepared(Posed& posed, const MeshOptions& given)
      : key(structural(given)), options(posed.pose.posed(given)), structures(posed.pose, options, posed.tets, posed.clock, posed.monitor) {}
  MeshOptions key;
  MeshOptions options;  // of the pose
  Structures structures;
};

Session::Session(CadModel model, const MeshOptions& options) : model_(std::move(model)), first_(checked(model_, options)) {}

Session::~Session() = default;

Session::Prepared& Session::prepared(const MeshOptions& options, const Monitor& monitor) {
  const auto follow = [&] {
    posed_->monitor.follow(monitor);
    posed_->clock.restart();
  };
  if (prepared_ && prepared_->key == structural(options)) {
    follow();
    return *prepared_;
  }
  MeshOptions made = options;  // of the size that was given first
  made.size = first_.size;
  made.max_size = first_.max_size;
  made.hexes = first_.hexes;
  made.coarsest = first_.coarsest;
  made.threads = first_.threads;
  prepared_.reset();
  if (!posed_ || posed_->frame != made.frame) posed_ = std::make_unique<Posed>(model_, made);
  follow();
  prepared_ = std::make_unique<Prepared>(*posed_, made);
  return *prepared_;
}

void Session::prepare(const Monitor& monitor) {
  Prepared& p = prepared(first_, monitor);
  try {
    p.structures.structure({.labels = p.structures.label_order().front()});
  } catch (const StageFailed& e) {
    monitor.log(e.stage() + ": " + e.what());
  }
}

MeshResult Session::mesh(const MeshOptions& given, const Monitor& monitor) {
  const MeshOptions options = checked(model_, given);
  Prepared& p = prepared(options, monitor);
  const Pose& pose = posed_->pose;
  const MeshOptions posed = pose.posed(options);
  MeshResult result = [&] {
    try {
      return search_mesh(pose, posed, p.structures, posed_->clock, posed_->monitor, monitor);
    } catch (const StageFailed& e) {
      throw with_labels(e, options.labels);
    }
  }();
  // A mesh that is there is handed out, late or not.
  const Monitor finishing(monitor, result.report.out_of_time ? Monitor::Clock::time_point::max() : monitor.deadline());
  restore(pose, model_, result.association, result.mesh, finishing);
  const QualitySummary quality = summarise(result.mesh);
  if (!(quality.min_scaled_jacobian > 0)) throw StageFailed("fit", "cells lose their volume on the way back to the part's place");
  MeshReport& r = result.report;
  r.options = given;
  r.warnings.insert(r.warnings.begin(), model_.warnings().begin(), model_.warnings().end());
  r.size /= pose.scale;
  r.quality = quality;
  r.shape = summarise_shape(result.mesh);
  r.volume = 0;
  for (const Hex& h : result.mesh.hexes) r.volume += hex_volume(result.mesh.points, h);
  r.cad_volume = model_.volume();
  r.worst = worst_cells(result.mesh, result.association);
  const Shortfalls short_of = find_shortfalls(model_, result.mesh, result.association, effective_min_layers(options), effective_per_circle(options));
  r.thin_walls = static_cast<int>(short_of.thin_walls.size());
  r.coarse_circles = static_cast<int>(short_of.coarse_circles.size());
  warn_of(short_of.thin_walls, "walls with fewer elements through them than asked for", r.warnings);
  warn_of(short_of.coarse_circles, "CAD edges with fewer elements along them than their turning asks for", r.warnings);
  warn_of(unmet_sizes(result.mesh, result.association, options.sizes), "sizes of faces that the cells do not have", r.warnings);
  r.loose_nodes = count_loose_nodes(model_, result.association, result.mesh.points);
  return result;
}

LabelledPart Session::labels(const MeshOptions& given, const Monitor& monitor, Until until) {
  check(given, model_.diagonal(), {model_.faces(), model_.edges(), model_.vertices()});
  Prepared& p = prepared(without_solids(given), monitor);
  const Labelled& labelled = p.structures.labelled();
  LabelledPart part;
  part.tets = labelled.mesh;
  part.labelling = labelled.labelling;
  part.label_report = labelled.report;
  if (until == Until::kMap) {
    const Structure& structure = p.structures.structure({.labels = labelled.variant});
    part.features = structure.features;
    part.map = structure.map;
    part.flipped = structure.flipped;
  } else {
    part.features = find_features(posed_->pose.model, part.tets, part.labelling, p.structures.left_out({}), monitor);
  }
  part.stages = posed_->clock.records();
  put_back(posed_->pose, part);
  return part;
}

int Session::count(const MeshOptions& given, const Monitor& monitor) {
  const MeshOptions options = checked(model_, given);
  Prepared& p = prepared(options, monitor);
  const MeshOptions posed = posed_->pose.posed(options);
  Evaluator evaluator(posed_->pose, posed, p.structures, posed_->clock, posed_->monitor);
  std::optional<StageFailed> failure;
  for (const Plan& plan : keeping_plans(posed, evaluator.label_order())) {
    if (plan.for_poor) continue;
    try {
      return evaluator.count(plan);
    } catch (const StageFailed& e) {
      if (!failure) failure = e;
    }
  }
  throw StageFailed(*failure);
}

MeshResult mesh(const CadModel& model, const MeshOptions& options, const Monitor& monitor) { return Session(model, options).mesh(options, monitor); }

}  // namespace polycube
