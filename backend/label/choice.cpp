#include "label/choice.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace polycube {
namespace {

// A quarter of a cylinder keeps one label.
constexpr double kFilletsWhole = 0.96;
constexpr double kStrict = 1000;
constexpr std::array kCompactness{3.0, 0.3};

// Those that take least liberties first.
std::vector<LabelVariant> variants(int frames) {
  std::vector<LabelVariant> list;
  const auto add = [&](LabelVariant v) {
    for (const double bend : {LabelOptions{}.widest_bend, kFilletsWhole}) {
      v.widest_bend = bend;
      list.push_back(v);
    }
  };
  for (const double strictness : {LabelOptions{}.strictness, kStrict}) {
    for (const bool narrow : {false, true}) add({.strictness = strictness, .narrow_regions = narrow});
  }
  for (int axis = 0; axis < 3; ++axis) add({.chamfer_axis = axis});
  for (const double compactness : kCompactness) add({.compactness = compactness});
  add({.gradual = false});
  for (int f = 1; f < frames; ++f) add({.frame = f});
  return list;
}

bool better(const Labelled& a, const Labelled& b) {
  return std::tuple(a.faults, a.lost_features, a.report.energy) < std::tuple(b.faults, b.lost_features, b.report.energy);
}

}  // namespace

LabelChoice::LabelChoice(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, std::vector<Mat3> frames, std::vector<char> left_out,
                         const Monitor& monitor)
    : model_(model), mesh_(mesh), options_(options), frames_(std::move(frames)), left_out_(std::move(left_out)), monitor_(monitor) {}

const Labelled& LabelChoice::labelled(const LabelVariant& variant) {
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Labelled& l) { return l.variant == variant; });
  if (found != made_.end()) return *found;
  Labelled result{variant, mesh_, {}, {}, 0, 0};
  LabelOptions options = options_;
  options.frame_given = true;
  options.frame = frames_[variant.frame];
  options.compactness *= variant.compactness;
  options.chamfer_axis = variant.chamfer_axis;
  options.gradual = variant.gradual;
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
  order_ = variants(static_cast<int>(frames_.size()));
  // Variants come in twins that differ in widest_bend.
  for (auto twins = order_.begin(); twins != order_.end(); twins += 2) {
    const Labelled& first = labelled(twins[0]);
    const bool settled = first.faults == 0 && first.lost_features == 0;
    if (!settled && first.faults > 0 && labelled(twins[1]).faults > 0) continue;
    if (!settled && better(labelled(twins[1]), first)) std::swap(twins[0], twins[1]);
    std::rotate(order_.begin(), twins, twins + 2);
    return order_;
  }
  std::stable_sort(order_.begin(), order_.end(), [&](const LabelVariant& a, const LabelVariant& b) { return better(labelled(a), labelled(b)); });
  return order_;
}

}  // namespace polycube
