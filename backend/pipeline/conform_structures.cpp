#include "pipeline/conform_structures.h"

#include <set>

#include "core/parallel.h"
#include "core/sorted.h"
#include "label/frame.h"
#include "pipeline/conform_demands.h"
#include "pipeline/conform_grid.h"
#include "pipeline/realise.h"
#include "pipeline/structures.h"

namespace polycube {
namespace {

LabelOptions labelling_of(const ConformalModel& model, const MeshOptions& options) {
  LabelOptions label = label_options(options);
  label.frame_given = true;
  label.frame = options.frame.empty() ? find_frame(model.whole) : frame_of(options.frame);
  return label;
}

std::vector<char> edges_of_interfaces(const ConformalModel& model) {
  std::vector<char> edges(static_cast<std::size_t>(model.whole.edge_count()) + 1, 0);
  for (const auto& interface : model.interfaces)
    for (const int e : model.whole.face(interface.first).edges) edges[static_cast<std::size_t>(e)] = 1;
  return edges;
}

}  // namespace

ConformalStructures::ConformalStructures(const ConformalModel& model, const TetMesh& tets, const MeshOptions& options, double size)
    : model_(model),
      tets_(tets),
      size_(size),
      threads_(thread_count(options.threads)),
      label_(labelling_of(model, options)),
      given_{labels_by_solid(options.labels, model, tets, label_.frame), ignored_edges(options, model)},
      interface_edges_(edges_of_interfaces(model)) {}

const ConformalLabels& ConformalStructures::labels(int number, StageClock& clock, const Monitor& monitor) {
  Attempt& attempt = attempts_[number];
  if (!attempt.labels && !attempt.failure) {
    try {
      attempt.labels = clock.stage("label", [&] { return label_conformally(model_, tets_, label_, given_, number, monitor); });
      attempt.repeats = !known_.insert({attempt.labels->labelling.label, attempt.labels->inner_label}).second;
    } catch (const StageFailed& e) {
      attempt.failure = e;
    }
  }
  if (!attempt.labels) throw StageFailed(*attempt.failure);
  return *attempt.labels;
}

const ConformalStructure* ConformalStructures::structure(int number, StageClock& clock, const Monitor& monitor) {
  const ConformalLabels& labelled = labels(number, clock, monitor);
  Attempt& attempt = attempts_[number];
  if (attempt.repeats) return nullptr;
  if (!attempt.structure && !attempt.failure) {
    try {
      attempt.structure = built(labelled, clock, monitor);
    } catch (const StageFailed& e) {
      attempt.failure = e;
    }
  }
  if (!attempt.structure) throw StageFailed(*attempt.failure);
  return attempt.structure.get();
}

namespace {

/// CAD faces that some tets have a side on, ascending.
std::vector<int> faces_at(const TetMesh& mesh, const std::vector<int>& tets) {
  std::set<Triangle> sides;
  for (const int t : tets)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Triangle side{};
      for (std::size_t k = 0; k < 3; ++k) side[k] = mesh.tets[t][(left_out + 1 + k) % 4];
      sides.insert(sorted(side));
    }
  std::set<int> faces;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (sides.contains(sorted(mesh.triangles[t]))) faces.insert(mesh.triangle_face[t]);
  for (std::size_t t = 0; t < mesh.inner_triangles.size(); ++t)
    if (sides.contains(sorted(mesh.inner_triangles[t]))) faces.insert(mesh.inner_face[t]);
  return {faces.begin(), faces.end()};
}

}  // namespace

std::unique_ptr<ConformalStructure> ConformalStructures::built(const ConformalLabels& labelled, StageClock& clock, const Monitor& monitor) const {
  auto made = std::make_unique<ConformalStructure>(ConformalStructure{labelled.mesh});
  made->between = interface_charts(labelled);
  std::vector<char> without = interface_edges_;
  for (std::size_t e = 0; e < without.size(); ++e) without[e] |= given_.left_out[e];
  made->features = clock.stage("label", [&] { return find_features(model_.outer, made->tets, labelled.labelling, without, monitor); });
  DeformOptions deform;
  deform.merge = merge_distance(size_, model_.outer.diagonal());
  deform.threads = threads_;
  RealisedMap realised =
      clock.stage("deform", [&] { return realise(model_.outer, made->tets, labelled.labelling, made->features, deform, monitor, made->between.charts); });
  made->map = std::move(realised.map);
  monitor.log("deform: " + std::to_string(made->map.charts.size()) + " charts, " + std::to_string(realised.report.flipped) + " flipped of " +
              std::to_string(made->tets.tets.size()) + " tets");
  made->folded_faces = faces_at(made->tets, realised.report.flipped_tets);
  made->blocks = clock.stage("blocks", [&] { return extract_blocks(made->tets, made->map, monitor); });
  made->block_solid = solids_of_blocks(made->tets, made->map, made->blocks);
  bound_at_interfaces(made->blocks, made->map, made->block_solid);
  return made;
}

}  // namespace polycube
