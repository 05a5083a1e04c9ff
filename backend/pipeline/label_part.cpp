#include "pipeline/label_part.h"

#include <algorithm>
#include <set>

#include "core/charts.h"
#include "label/order.h"
#include "pipeline/realise.h"
#include "pipeline/stage_clock.h"
#include "pipeline/structures.h"

namespace polycube {
namespace {

// Where the charts would have to rise for ever.
std::optional<StageFailed> unrealisable(const LabelledPart& part) {
  const RisingLoop loop = find_rising_loop(part.tets, part.labelling.frame, part.labelling.label);
  if (loop.charts.empty()) return std::nullopt;
  const std::vector<Chart> charts = find_charts(part.tets.triangles, part.labelling.label);
  std::string text =
      "no map can have these labels: along one axis each of these charts would have to lie beyond the one before it, and the first beyond the last:";
  std::set<int> faces;
  for (int c : loop.charts) {
    text += " " + std::to_string(c);
    for (int t : charts[c].triangles) faces.insert(part.tets.triangle_face[t]);
  }
  std::vector<CadRef> at;
  at.reserve(faces.size());
  for (int f : faces) at.push_back({2, f});
  return StageFailed("label", text, at);
}

}  // namespace

LabelledPart label_part(const CadModel& model, const MeshOptions& given, const Monitor& monitor, Until until) {
  LabelledPart part;
  StageClock clock(monitor);
  const Pose pose = canonical_pose(model, given.frame);
  const MeshOptions options = pose.posed(given);
  TetMeshes tets(pose.model, wanted_size(options, pose.model), clock, monitor);
  Structures structures(pose, options, tets, clock, monitor);
  const Labelled& best = structures.labelled();
  part.tets = best.mesh;
  part.labelling = best.labelling;
  part.label_report = best.report;
  part.features = clock.stage("label", [&] { return find_features(pose.model, part.tets, part.labelling, structures.left_out({}), monitor); });
  if (until == Until::kMap) {
    clock.stage("deform", [&] {
      try {
        RealisedMap realised = realise(pose.model, part.tets, part.labelling, part.features, structures.deform_options(), monitor);
        part.map = std::move(realised.map);
        part.flipped = realised.report.flipped;
      } catch (const StageFailed& e) {
        const std::optional<StageFailed> loop = unrealisable(part);
        part.failure = loop ? *loop : e;
      }
    });
  }
  part.stages = clock.records();
  put_back(pose, part);
  return part;
}

void put_back(const Pose& pose, LabelledPart& part) {
  for (Vec3& p : part.tets.points) p = pose.back(p);
  part.labelling.frame = pose.user_axes(part.labelling.frame);
  for (int& l : part.labelling.label) l = pose.user_label(l);
  for (FeatureChart& f : part.features.charts) pose.map_back(f.chart);
  for (Vec3& p : part.map.image) p = pose.map_back(p);
  for (Chart& c : part.map.charts) pose.map_back(c);
}

}  // namespace polycube
