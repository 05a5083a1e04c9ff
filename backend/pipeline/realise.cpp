#include "pipeline/realise.h"

#include <algorithm>

namespace polycube {
namespace {

constexpr int kRounds = 4;

}  // namespace

RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor) {
  RealisedMap bare;
  bare.map = deform(tets, labelling.frame, labelling.label, {}, options, monitor, &bare.report);
  if (features.charts.empty()) return bare;
  std::vector<char> folded(tets.tets.size(), 0);
  for (int t : bare.report.flipped_tets) folded[t] = 1;
  std::vector<std::vector<int>> edges_at(tets.points.size());
  for (std::size_t i = 0; i < tets.segments.size(); ++i) {
    for (int n : tets.segments[i]) edges_at[n].push_back(tets.segment_edge[i]);
  }
  RealisedMap result;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Chart> charts;
    for (const FeatureChart& f : features.charts) charts.push_back(f.chart);
    result.map = deform(tets, labelling.frame, labelling.label, charts, options, monitor, &result.report);
    std::vector<int> blame(static_cast<std::size_t>(model.edge_count()) + 1, 0);
    for (int t : result.report.flipped_tets) {
      if (folded[t]) continue;
      std::vector<int> near;
      for (int n : tets.tets[t]) near.insert(near.end(), edges_at[n].begin(), edges_at[n].end());
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      for (int e : near) ++blame[e];
    }
    int worst = 0;
    for (const FeatureChart& f : features.charts) worst = std::max(worst, blame[f.edge]);
    if (worst == 0) break;
    if (round + 1 == kRounds) return bare;
    // Those that fold much go first: others may only stand beside them.
    for (FeatureEdge& e : features.edges) {
      if (e.capture != EdgeCapture::kFeature || 3 * blame[e.edge] < worst) continue;
      e.capture = EdgeCapture::kLost;
      e.reason = "the map folds there";
    }
    std::erase_if(features.charts, [&](const FeatureChart& f) { return 3 * blame[f.edge] >= worst; });
    if (features.charts.empty()) return bare;
  }
  // Folds that cannot be blamed on single features: none of them is worth it.
  return result.report.flipped <= bare.report.flipped + 5 ? result : bare;
}

}  // namespace polycube
