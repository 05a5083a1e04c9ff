#include "pad/pad.h"

#include "core/error.h"
#include "pad/rings.h"
#include "pad/surface.h"

namespace polycube {

PaddedMesh pad(const CadModel& model, const HexMesh& mesh, const Association& association, const Monitor& monitor, PadReport* report) {
  const auto faults_before = check(mesh, association);
  if (!faults_before.empty()) throw StageFailed("pad", "the mesh handed to padding is not sound: " + faults_before[0]);
  PaddedMesh padded;
  PadReport counts;
  double best = -1;
  double done = 0.1;
  for (const LayerPlan plan : {LayerPlan::kEach, LayerPlan::kTogether, LayerPlan::kTogetherThrough}) {
    monitor.progress("pad", done);
    done += 0.25;
    PaddedMesh candidate{mesh, association};
    const LayerCount layers = insert_surface_layers(model, candidate, plan, monitor);
    const RingCount rings = insert_rings(model, candidate, monitor);
    if (layers.gain + rings.gain > best) {
      best = layers.gain + rings.gain;
      padded = std::move(candidate);
      counts = {layers.quads, rings.sheets, 0};
    }
    if (plan == LayerPlan::kEach && layers.regions <= 1) break;  // the first plan tries every way for a single region
  }
  counts.added_hexes = static_cast<int>(padded.mesh.hexes.size() - mesh.hexes.size());
  const auto faults = check(padded.mesh, padded.association);
  if (!faults.empty()) throw StageFailed("pad", "padding broke the mesh: " + faults[0]);
  if (report) *report = counts;
  monitor.progress("pad", 1);
  return padded;
}

}  // namespace polycube
