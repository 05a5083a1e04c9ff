#include "label/choice.h"

#include <algorithm>
#include <tuple>

namespace polycube {
namespace {

// A quarter of a cylinder keeps one label.
constexpr double kFilletsWhole = 0.96;
constexpr double kStrict = 1000;

// Those that take least liberties first.
std::vector<LabelVariant> variants() {
  std::vector<LabelVariant> list;
  for (const double strictness : {LabelOptions{}.strictness, kStrict}) {
    for (const bool narrow : {false, true}) {
      for (const double bend : {LabelOptions{}.widest_bend, kFilletsWhole}) list.push_back({strictness, bend, narrow});
    }
  }
  return list;
}

}  // namespace

LabelChoice::LabelChoice(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, std::vector<char> left_out, const Monitor& monitor)
    : model_(model), mesh_(mesh), options_(options), left_out_(std::move(left_out)), monitor_(monitor) {}

const Labelled& LabelChoice::labelled(const LabelVariant& variant) {
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Labelled& l) { return l.variant == variant; });
  if (found != made_.end()) return *found;
  Labelled result{variant, mesh_, {}, {}, 0, 0};
  LabelOptions options = options_;
  options.strictness = variant.strictness;
  options.widest_bend = variant.widest_bend;
  options.narrow_regions = variant.narrow_regions;
  result.labelling = label(model_, result.mesh, options, monitor_, &result.report);
  result.faults = result.report.score;
  for (const FeatureEdge& e : find_features(model_, result.mesh, result.labelling, left_out_, monitor_).edges) result.lost_features += e.capture == EdgeCapture::kLost;
  made_.push_back(std::move(result));
  return made_.back();
}

const std::vector<LabelVariant>& LabelChoice::order() {
  if (!order_.empty()) return order_;
  order_ = variants();
  const auto faultless = std::find_if(order_.begin(), order_.end(), [&](const LabelVariant& v) { return labelled(v).faults == 0; });
  if (faultless != order_.end()) {
    LabelVariant twin = *faultless;
    twin.widest_bend = twin.widest_bend == kFilletsWhole ? LabelOptions{}.widest_bend : kFilletsWhole;
    std::rotate(order_.begin(), faultless, faultless + 1);
    const auto second = std::find(order_.begin(), order_.end(), twin);
    std::rotate(order_.begin() + 1, second, second + 1);
    return order_;
  }
  std::stable_sort(order_.begin(), order_.end(), [&](const LabelVariant& a, const LabelVariant& b) {
    const auto rank = [&](const LabelVariant& v) {
      const Labelled& l = labelled(v);
      return std::tuple(l.faults, l.lost_features, l.report.energy);
    };
    return rank(a) < rank(b);
  });
  return order_;
}

}  // namespace polycube
