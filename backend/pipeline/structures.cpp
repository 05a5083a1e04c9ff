#include "pipeline/structures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/parallel.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

// A few flips more or less say nothing, four times as many do.
int magnitude(int flipped) { return static_cast<int>(std::log2(1 + static_cast<double>(flipped) / kPipelineTuning.few_flips) / 2); }

void repeat(Structure& s) {
  s.repeats = true;
  s.failure = StageFailed("label", "the same as one before");
}

bool in_doubt(const Structure& s) { return s.failure || s.flipped > kPipelineTuning.few_flips; }

}  // namespace

double wanted_size(const MeshOptions& options, const CadModel& model) {
  return options.hexes > 0 ? std::cbrt(model.volume() / options.hexes) : effective_size(options, model.diagonal());
}

TetOptions tet_options(double size, double diagonal, double factor) {
  TetOptions result;
  // The map needs enough tets to bend; more than that costs time and brings nothing, the hexahedra need not be as fine.
  result.size = factor * std::clamp(size, diagonal / 50, diagonal / 30);
  return result;
}

double merge_distance(double size, double diagonal) { return 0.02 * std::min(size, diagonal / 30); }

MeshOptions structural(const MeshOptions& options) {
  MeshOptions result;
  result.labels = options.labels;
  result.frame = options.frame;
  result.feature_angle = options.feature_angle;
  result.keep_faces = options.keep_faces;
  result.fidelity = options.fidelity;
  result.compactness = options.compactness;
  const bool by_axis = std::any_of(options.sizes.begin(), options.sizes.end(), [](const LocalSize& s) { return s.face == 0 && s.solid == 0; });
  if (by_axis) result.sizes = {{.axis = 0, .size = 1}};
  return result;
}

LabelOptions label_options(const MeshOptions& options) {
  LabelOptions result;
  result.fidelity = options.fidelity;
  result.compactness = options.compactness;
  result.face_labels = options.labels;
  result.threads = thread_count(options.threads);
  return result;
}

TetMeshes::TetMeshes(const CadModel& model, double size, StageClock& clock, const Monitor& monitor)
    : model_(model), size_(size), clock_(clock), monitor_(monitor) {}

const TetMesh& TetMeshes::mesh(double factor) {
  const auto found = made_.find(factor);
  if (found == made_.end()) {
    Made made;
    try {
      made.mesh = clock_.stage("tet", [&] { return tetrahedralise(model_, tet_options(size_, model_.diagonal(), factor), monitor_); });
    } catch (const StageFailed& e) {
      made.failure = e;
    }
    made_.emplace(factor, std::move(made));
  }
  const Made& kept = made_.at(factor);
  if (kept.failure) throw StageFailed(*kept.failure);
  return kept.mesh;
}

Structures::Structures(const Pose& pose, const MeshOptions& options, TetMeshes& tets, StageClock& clock, const Monitor& monitor)
    : pose_(pose),
      model_(pose.model),
      options_(options),
      size_(wanted_size(options, pose.model)),
      ignored_(smooth_edges(pose.model, options.feature_angle * std::numbers::pi / 180, options.keep_faces)),
      tets_(tets),
      clock_(clock),
      monitor_(monitor) {}

LabelChoice& Structures::labellings(double tet_size) {
  const auto found = labellings_.find(tet_size);
  if (found != labellings_.end()) return found->second;
  const TetMesh& mesh = tets_.mesh(tet_size);
  pose_.check_labels(mesh, options_.labels);
  const auto usual = labellings_.find(1);
  const bool first = usual == labellings_.end();
  return labellings_
      .try_emplace(tet_size, model_, mesh, label_options(options_), first ? pose_.frames(options_) : usual->second.frames(), first && pose_.may_turn(options_),
                   ignored_, monitor_)
      .first->second;
}

std::vector<LabelVariant> Structures::label_order() {
  std::vector<LabelVariant> order;
  try {
    LabelChoice& choice = labellings(1);
    order = clock_.stage("label", [&] { return choice.order(); });
  } catch (const StageFailed&) {
    return {LabelVariant{}};
  }
  if (in_doubt(built({.labels = order.front()}))) sort_by_map(order);
  const Structure& best = built({.labels = order.front()});
  if (best.failure || best.flipped > 0) prefer_facing(order);
  if (const std::optional<LabelVariant> along = along_bend()) order.insert(order.begin() + (rough_rank(*along) < rough_rank(order.front()) ? 0 : 1), *along);
  return order;
}

// Where the map of the first turns tets over, and regions of it stand square to their label's axis: those with fewer such regions and other frames, if nothing
// else is wrong with them, by the tets that their maps turn over.
void Structures::prefer_facing(std::vector<LabelVariant>& order) {
  const Labelled& first = labelled(order.front());
  if (first.report.folded_parts == 0) return;
  std::vector<LabelVariant> more;
  for (const LabelVariant& v : labellings(1).facing(order.front())) {
    const Labelled& l = labelled(v);
    const auto is_the_same = [&](const LabelVariant& other) { return same_labels(v, other); };
    if (l.faults <= first.faults && l.report.folded_parts <= first.report.folded_parts && std::none_of(more.begin(), more.end(), is_the_same))
      more.push_back(v);
  }
  std::stable_sort(more.begin(), more.end(),
                   [&](const LabelVariant& x, const LabelVariant& y) { return labelled(x).report.folded_parts < labelled(y).report.folded_parts; });
  more.insert(more.begin(), order.front());
  more.resize(std::min(more.size(), kPipelineTuning.mapped));
  std::stable_sort(more.begin(), more.end(), [&](const LabelVariant& x, const LabelVariant& y) { return rank_by_map(x) < rank_by_map(y); });
  // Some flips more are worth fewer such regions.
  const Rank least = rank_by_map(more.front());
  const auto end = std::find_if(more.begin(), more.end(), [&](const LabelVariant& v) {
    const Rank rank = rank_by_map(v);
    return rank.fails || rank.flipped > kPipelineTuning.facing_folds * least.flipped + kPipelineTuning.few_folds ||
           rank.flipped > std::max<double>(least.flipped, kPipelineTuning.facing_share * static_cast<double>(labelled(v).mesh.tets.size()));
  });
  std::stable_sort(more.begin(), end,
                   [&](const LabelVariant& x, const LabelVariant& y) { return labelled(x).report.folded_parts < labelled(y).report.folded_parts; });
  order.erase(order.begin());
  order.insert(order.begin(), more.begin(), more.end());
}

const Labelled& Structures::labelled(const LabelVariant& variant, double tet_size) {
  LabelChoice& choice = labellings(tet_size);
  return clock_.stage("label", [&]() -> const Labelled& { return choice.labelled(variant); });
}

std::optional<LabelVariant> Structures::along_bend() {
  LabelChoice& choice = labellings(1);
  return clock_.stage("label", [&] { return choice.along_bend(); });
}

std::tuple<bool, int, double> Structures::rough_rank(const LabelVariant& variant) {
  const Rank rank = rank_by_map(variant);
  return {rank.fails, magnitude(rank.flipped), rank.distortion};
}

const Labelled& Structures::labelled() {
  LabelChoice& choice = labellings(1);
  const LabelVariant first = clock_.stage("label", [&] { return choice.order().front(); });
  const std::optional<LabelVariant> along = along_bend();
  return labelled(along && rough_rank(*along) < rough_rank(first) ? *along : first);
}

DeformOptions Structures::deform_options() const {
  DeformOptions result;
  result.merge = merge_distance(size_, model_.diagonal());
  result.threads = thread_count(options_.threads);
  return result;
}

const Structures::BareMap& Structures::bare_map(const LabelVariant& variant, double tet_size) {
  const auto found = bare_.find({variant, tet_size});
  if (found != bare_.end()) return found->second;
  const Labelled& chosen = labelled(variant, tet_size);
  BareMap made;
  try {
    made.realised = realise_bare(chosen.mesh, chosen.labelling, deform_options(), monitor_);
  } catch (const StageFailed& e) {
    made.failure = e;
  }
  return bare_.emplace(std::pair(variant, tet_size), std::move(made)).first->second;
}

// Features are not what tells labellings apart, and to find out which of them a map can hold takes up to four maps more.
Structures::Rank Structures::rank_by_map(const LabelVariant& variant) {
  const BareMap& bare = clock_.stage("deform", [&]() -> const BareMap& { return bare_map(variant, 1); });
  const auto made = structures_.find({.labels = variant});
  const bool fails = bare.failure || (made != structures_.end() && made->second.failure);
  return {fails, bare.realised.report.flipped, bare.realised.report.distortion};
}

bool Structures::same_labels(const LabelVariant& a, const LabelVariant& b) {
  return a.frame == b.frame && labelled(a).labelling.label == labelled(b).labelling.label;
}

// Those that are as good as the first in all that can be said without a map.
void Structures::sort_by_map(std::vector<LabelVariant>& order) {
  const auto without_map = [&](const LabelVariant& v) {
    const Labelled& l = labelled(v);
    return std::tuple(l.faults, l.lost_features);
  };
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), kPipelineTuning.mapped));
  const auto end = std::find_if(order.begin(), last, [&, first = without_map(order.front())](const LabelVariant& v) { return without_map(v) > first; });
  // The same labels twice would take the place of others.
  const auto repeated = [&](auto v) { return std::any_of(order.begin(), v, [&](const LabelVariant& earlier) { return same_labels(earlier, *v); }); };
  std::vector<std::pair<std::tuple<bool, int, double>, LabelVariant>> ranked;
  for (auto v = order.begin(); v != end; ++v) {
    ranked.emplace_back(rough_rank(*v), *v);
    if (repeated(v)) std::get<bool>(ranked.back().first) = true;
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::transform(ranked.begin(), ranked.end(), order.begin(), [](const auto& r) { return r.second; });
}

bool Structures::doubtful(const StructurePlan& plan) {
  try {
    LabelChoice& choice = labellings(plan.tet_size);
    return !choice.labelled(plan.labels).report.valid() && choice.labelled(choice.order().front()).report.valid();
  } catch (const StageFailed&) {
    return false;
  }
}

std::vector<char> Structures::left_out(const StructurePlan& plan) const {
  std::vector<char> out = smooth_edges(model_, plan.min_bend);
  for (std::size_t e = 0; e < out.size(); ++e) out[e] |= ignored_[e];
  return out;
}

const Structure& Structures::built(const StructurePlan& plan) {
  const auto found = structures_.find(plan);
  if (found != structures_.end()) return found->second;
  Structure structure;
  std::vector<std::vector<int>> made;
  try {
    build(plan, structure, made);
  } catch (const StageFailed& e) {
    structure.failure = e;
  }
  tried_.insert(std::move(made));
  return structures_.emplace(plan, std::move(structure)).first->second;
}

const Structure& Structures::structure(const StructurePlan& plan) {
  const Structure& s = built(plan);
  if (s.failure) throw StageFailed(*s.failure);
  return s;
}

bool Structures::repeats(const StructurePlan& plan) { return built(plan).repeats; }

// `made` becomes its labels and features.
void Structures::build(const StructurePlan& plan, Structure& s, std::vector<std::vector<int>>& made) {
  // Where nothing is wrong, stricter labels would be the same; to those that face their axes, a region that does not is wrong.
  if (plan.labels != plain(plan.labels)) {
    const Labelled& usual = labelled(plain(plan.labels), plan.tet_size);
    if (usual.faults == 0 && (!plan.labels.facing || usual.report.folded_parts == 0)) return repeat(s);
  }
  const Labelled& chosen = labelled(plan.labels, plan.tet_size);
  const std::vector<char> out = left_out(plan);
  s.tets = chosen.mesh;
  s.features = clock_.stage("label", [&] { return find_features(model_, s.tets, chosen.labelling, out, monitor_); });
  if (!plan.features) s.features.charts.clear();
  made.push_back(chosen.labelling.label);
  for (const FeatureEdge& e : s.features.edges) made.push_back({e.edge, static_cast<int>(e.capture), out[e.edge]});
  made.push_back({static_cast<int>(s.features.charts.size())});
  if (tried_.contains(made)) return repeat(s);
  for (const FeatureEdge& e : s.features.edges) {
    if (e.capture == EdgeCapture::kLost && !out[e.edge]) monitor_.log("label: " + name({1, e.edge}) + " has no feature chart: " + e.reason);
  }

  const auto bare = [&]() -> const RealisedMap& {
    const BareMap& map = bare_map(plan.labels, plan.tet_size);
    if (map.failure) throw StageFailed(*map.failure);
    return map.realised;
  };
  RealisedMap realised = clock_.stage("deform", [&] { return realise(model_, s.tets, chosen.labelling, s.features, deform_options(), monitor_, bare); });
  s.map = std::move(realised.map);
  s.flipped = realised.report.flipped;
  s.distortion = realised.report.distortion;
  monitor_.log("deform: " + std::to_string(s.map.charts.size()) + " charts, " + std::to_string(s.flipped) + " flipped of " +
               std::to_string(s.tets.tets.size()) + " tets, distortion " + std::to_string(s.distortion));
  s.blocks = clock_.stage("blocks", [&] { return extract_blocks(s.tets, s.map, monitor_); });
}

}  // namespace polycube
