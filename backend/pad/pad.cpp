#include "pad/pad.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "pad/rings.h"
#include "pad/surface.h"

namespace polycube {

namespace {

struct Choice {
  PaddedMesh padded;
  PadReport report;
  double gain = 0;
};

// A choice that leaves this much more to be desired than the best leaves two cells flat that the best does not.
constexpr double kHopeless = 2500;

}  // namespace

std::vector<PaddedMesh> pad_choices(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor,
                                    std::vector<PadReport>* reports, const std::vector<int>& fixed_faces) {
  const auto faults_before = check(mesh, association);
  if (!faults_before.empty()) throw StageFailed("pad", "the mesh handed to padding is not sound: " + faults_before[0]);
  std::vector<Choice> choices;
  std::optional<Choice> through_cusps;
  double done = 0.1;
  for (const LayerPlan plan : {LayerPlan::kEach, LayerPlan::kBands, LayerPlan::kTogether, LayerPlan::kTogetherThrough}) {
    monitor.progress("pad", done);
    done += 0.2;
    PaddedMesh layered{mesh, association, fixed_faces};
    const LayerCount layers = insert_surface_layers(model, layered, plan, monitor);
    RingCount rings;
    const auto ringed = [&](RingWay way) {
      Choice choice{layered, {}, 0};
      rings = insert_rings(model, choice.padded, way, monitor);
      const auto faults = check(choice.padded.mesh, choice.padded.association);
      if (!faults.empty()) throw StageFailed("pad", "padding broke the mesh: " + faults[0]);
      choice.gain = layers.gain + rings.gain;
      choice.report = {layers.quads, rings.sheets, static_cast<int>(choice.padded.mesh.hexes.size() - mesh.hexes.size())};
      return choice;
    };
    Choice choice = ringed(RingWay::kPlain);
    if (rings.flat && rings.cusps) {
      Choice other = ringed(RingWay::kThroughCusps);
      if (other.gain > std::max(choice.gain, through_cusps ? through_cusps->gain : 0)) through_cusps = std::move(other);
    }
    const bool known = std::any_of(choices.begin(), choices.end(), [&](const Choice& other) { return other.padded.mesh.hexes == choice.padded.mesh.hexes; });
    if (!known) choices.push_back(std::move(choice));
    if (plan == LayerPlan::kEach && layers.regions == 0) break;  // nothing for the other plans to do
  }
  std::stable_sort(choices.begin(), choices.end(), [](const Choice& a, const Choice& b) { return a.gain > b.gain; });
  const double enough = choices[0].gain - kHopeless;
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
