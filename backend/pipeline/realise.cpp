#include "pipeline/realise.h"

#include <algorithm>
#include <optional>

#include "pipeline/tuning.h"

namespace polycube {

RealisedMap realise_bare(const TetMesh& tets, const Labelling& labelling, const DeformOptions& options, const Monitor& monitor,
                         const std::vector<Chart>& fixed) {
  RealisedMap bare;
  bare.map = deform(tets, labelling.frame, labelling.label, fixed, options, monitor, &bare.report);
  return bare;
}

RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor, const std::vector<Chart>& fixed) {
  std::optional<RealisedMap> made;
  const auto bare = [&]() -> const RealisedMap& {
    if (!made) made = realise_bare(tets, labelling, options, monitor, fixed);
    return *made;
  };
  return realise(model, tets, labelling, features, options, monitor, bare, fixed);
}

RealisedMap realise(const CadModel& model, const TetMesh& tets, const Labelling& labelling, Features& features, const DeformOptions& options,
                    const Monitor& monitor, const std::function<const RealisedMap&()>& bare, const std::vector<Chart>& fixed) {
  if (features.charts.empty()) return bare();
  std::vector<char> folded(tets.tets.size(), 0);
  std::vector<std::vector<int>> edges_at(tets.points.size());
  for (std::size_t i = 0; i < tets.segments.size(); ++i) {
    for (int n : tets.segments[i]) edges_at[n].push_back(tets.segment_edge[i]);
  }
  RealisedMap result;
  const auto without = [&](const auto& which) {
    for (FeatureEdge& e : features.edges) {
      if (e.capture != EdgeCapture::kFeature || !which(e.edge)) continue;
      e.capture = EdgeCapture::kLost;
      e.reason = "the map folds there";
    }
    std::erase_if(features.charts, [&](const FeatureChart& f) { return which(f.edge); });
  };
  const auto give_up = [&] {
    without([](int) { return true; });
    return bare();
  };
  for (int round = 0; round < kPipelineTuning.realise_rounds; ++round) {
    std::vector<Chart> charts;
    for (const FeatureChart& f : features.charts) charts.push_back(f.chart);
    charts.insert(charts.end(), fixed.begin(), fixed.end());
    result.map = deform(tets, labelling.frame, labelling.label, charts, options, monitor, &result.report);
    if (result.report.flipped == 0) return result;
    for (int t : bare().report.flipped_tets) folded[t] = 1;
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
    if (worst == 0 || round + 1 == kPipelineTuning.realise_rounds) break;
    // Those that fold much go first: others may only stand beside them.
    without([&](int e) { return 3 * blame[e] >= worst; });
    if (features.charts.empty()) return bare();
  }
  // Many folds more that cannot be blamed on single features: none of them is worth it. The blocks bear a few.
  const int folds = bare().report.flipped;
  return result.report.flipped <= folds + std::max(kPipelineTuning.few_folds, folds / 2) ? result : give_up();
}

}  // namespace polycube
