#include "pad/pad.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "pad/rings.h"
#include "pad/surface.h"
#include "pad/tuning.h"

namespace polycube {

namespace {

struct Choice {
  PaddedMesh padded;
  PadReport report;
  double gain = 0;
};

constexpr std::array kPlans{LayerPlan::kEach, LayerPlan::kBands, LayerPlan::kTogether, LayerPlan::kTogetherThrough};

struct Padder {
  const CadModel& model;
  PaddedMesh bare;
  const Monitor& monitor;

  Choice ringed(const PaddedMesh& layered, const LayerCount& layers, RingWay way, RingCount& rings) const {
    Choice choice{layered, {}, 0};
    rings = insert_rings(model, choice.padded, way, monitor);
    const auto faults = check(choice.padded.mesh, choice.padded.association);
    if (!faults.empty()) throw StageFailed("pad", "padding broke the mesh: " + faults[0]);
    choice.gain = layers.gain + rings.gain;
    choice.report = {layers.quads, rings.sheets, static_cast<int>(choice.padded.mesh.hexes.size() - bare.mesh.hexes.size())};
    return choice;
  }
};

// What one plan comes to.
struct Padded {
  PaddedMesh layered;
  LayerCount layers;
  std::optional<Choice> plain, through_cusps;

  void layer(const Padder& padder, LayerPlan plan) {
    layered = padder.bare;
    layers = insert_surface_layers(padder.model, layered, plan, padder.monitor);
  }
  void ring(const Padder& padder) {
    RingCount rings;
    plain = padder.ringed(layered, layers, RingWay::kPlain, rings);
    if (rings.flat && rings.cusps) through_cusps = padder.ringed(layered, layers, RingWay::kThroughCusps, rings);
  }
};

}  // namespace

std::vector<PaddedMesh> pad_choices(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor,
                                    std::vector<PadReport>* reports, const std::vector<int>& fixed_faces, int threads) {
  const auto faults_before = check(mesh, association);
  if (!faults_before.empty()) throw StageFailed("pad", "the mesh handed to padding is not sound: " + faults_before[0]);
  monitor.progress("pad", 0.1);
  const Padder padder{model, {mesh, association, fixed_faces}, monitor};
  std::vector<Padded> tried(kPlans.size());
  tried[0].layer(padder, kPlans[0]);
  if (tried[0].layers.regions == 0) tried.resize(1);  // nothing for the other plans to do
  std::vector<std::exception_ptr> failures(tried.size());
  std::atomic<int> done{1};
  share_chunks(static_cast<int>(tried.size()), threads, [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    try {
      if (i > 0) tried[at].layer(padder, kPlans[at]);
      tried[at].ring(padder);
    } catch (...) {
      failures[at] = std::current_exception();
    }
    monitor.progress("pad", 0.2 * ++done);
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);

  std::vector<Choice> choices;
  std::optional<Choice> through_cusps;
  for (Padded& one : tried) {
    Choice& choice = *one.plain;
    if (one.through_cusps && one.through_cusps->gain > std::max(choice.gain, through_cusps ? through_cusps->gain : 0))
      through_cusps = std::move(one.through_cusps);
    const bool known = std::any_of(choices.begin(), choices.end(), [&](const Choice& other) { return other.padded.mesh.hexes == choice.padded.mesh.hexes; });
    if (!known) choices.push_back(std::move(choice));
  }
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) { return a.gain > b.gain; });
  const double enough = choices[0].gain - kPadTuning.hopeless;
  // The second best stays in any case: angles do not tell all.
  while (choices.size() > 2 && choices.back().gain < enough) choices.pop_back();
  // More cells for fewer flat ones: it pays where the flat ones would be inverted, which the fit shows.
  if (through_cusps) choices.push_back(std::move(*through_cusps));
  std::vector<PaddedMesh> padded;
  if (reports) reports->clear();
  for (Choice& choice : choices) {
    padded.push_back(std::move(choice.padded));
    if (reports) reports->push_back(choice.report);
  }
  monitor.progress("pad", 1);
  return padded;
}

PaddedMesh pad(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor, PadReport* report) {
  std::vector<PadReport> reports;
  std::vector<PaddedMesh> choices = pad_choices(model, mesh, association, monitor, &reports);
  if (report) *report = reports[0];
  return std::move(choices[0]);
}

}  // namespace polycube
