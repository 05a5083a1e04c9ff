#include "label/choice.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "label/frame.h"
#include "label/tuning.h"
#include "label/validity.h"

namespace polycube {
namespace {

// What the shape gives a choice of.
struct Choices {
  bool bends = false;              // some face has one label with the wider widest_bend only
  std::array<bool, 3> chamfers{};  // some plane is oblique to this axis and another
  int frames = 1;
};

Choices choices_of(const CadModel& model, const TetMesh& mesh, const std::vector<Mat3>& frames) {
  Choices result;
  result.frames = static_cast<int>(frames.size());
  std::vector<Vec3> normal, mean(static_cast<std::size_t>(model.face_count()) + 1, Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 w = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    normal.push_back(w.normalized());
    mean[mesh.triangle_face[t]] += w;
  }
  std::vector<double> least(mean.size(), 1);
  for (std::size_t t = 0; t < normal.size(); ++t) {
    const int f = mesh.triangle_face[t];
    least[f] = std::min(least[f], normal[t].dot(mean[f].normalized()));
  }
  for (const int f : model.faces()) {
    const CadFace& face = model.face(f);
    result.bends = result.bends || face.kind == SurfaceKind::kTorus ||
                   (least[f] < std::cos(LabelOptions{}.widest_bend) && least[f] >= std::cos(kLabelTuning.fillets_whole));
    for (int axis = 0; axis < 3; ++axis) result.chamfers[axis] = result.chamfers[axis] || is_chamfer(face, frames.front(), axis);
  }
  return result;
}

// Those that take least liberties first; twins, which differ in widest_bend only, follow each other.
std::vector<LabelVariant> variants(const Choices& choices) {
  std::vector<LabelVariant> list;
  const auto add = [&](LabelVariant v) {
    list.push_back(v);
    v.widest_bend = kLabelTuning.fillets_whole;
    if (choices.bends) list.push_back(v);
  };
  for (const double strictness : {LabelOptions{}.strictness, kLabelTuning.strict}) {
    for (const bool narrow : {false, true}) add({.strictness = strictness, .narrow_regions = narrow});
  }
  list.push_back({.room = false});
  for (int axis = 0; axis < 3; ++axis) {
    if (choices.chamfers[axis]) add({.chamfer_axis = axis});
  }
  for (int f = 1; f < choices.frames; ++f) list.push_back({.frame = f});  // costly: most faces are oblique in it
  for (const double compactness : kLabelTuning.compactness) add({.compactness = compactness});
  add({.gradual = false});
  return list;
}

using VariantIterator = std::vector<LabelVariant>::const_iterator;

bool has_twin(VariantIterator v, VariantIterator end) {
  if (v + 1 == end) return false;
  LabelVariant twin = *v;
  twin.widest_bend = v[1].widest_bend;
  return twin == v[1];
}

std::string describe(const LabelVariant& v) {
  std::string text = "faces bend up to " + std::to_string(std::lround(v.widest_bend * 180 / std::numbers::pi)) + " degrees, strictness " +
                     std::to_string(std::lround(v.strictness));
  if (!v.gradual) text += " at once";
  if (v.facing) text += ", facing their axes";
  if (v.narrow_regions) text += ", narrow regions";
  if (!v.room) text += ", no room beside edges";
  if (v.chamfer_axis >= 0) text += std::string(", chamfers along ") + "xyz"[v.chamfer_axis];
  if (v.compactness > 1) text += ", compact";
  if (v.compactness < 1) text += ", loose";
  if (v.frame > 0) text += ", frame " + std::to_string(v.frame + 1);
  return text;
}

// What is wrong before the labels are ranked by how near they are to the normals.
double badness(const Labelled& l) { return l.faults + kLabelTuning.lost_feature * l.lost_features; }

bool better(const Labelled& a, const Labelled& b) {
  const auto rank = [](const Labelled& l) { return std::tuple(l.faults > 0, badness(l), l.report.energy); };
  return rank(a) < rank(b);
}

bool same_labels(const Labelled& a, const Labelled& b) { return a.variant.frame == b.variant.frame && a.labelling.label == b.labelling.label; }

}  // namespace

LabelVariant plain(LabelVariant v) {
  v.strictness = LabelVariant{}.strictness;
  v.narrow_regions = LabelVariant{}.narrow_regions;
  v.gradual = LabelVariant{}.gradual;
  return v;
}

LabelChoice::LabelChoice(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, std::vector<Mat3> frames, bool more_frames,
                         std::vector<char> left_out, const Monitor& monitor)
    : model_(model), mesh_(mesh), options_(options), frames_(std::move(frames)), more_frames_(more_frames), left_out_(std::move(left_out)), monitor_(monitor) {}

const Labelled& LabelChoice::labelled(const LabelVariant& variant) {
  const auto found = std::find_if(made_.begin(), made_.end(), [&](const Labelled& l) { return l.variant == variant; });
  if (found != made_.end()) return *found;
  Labelled result{variant, mesh_, {}, {}, 0, 0, {}};
  LabelOptions options = options_;
  options.frame_given = true;
  options.frame = frames_[variant.frame];
  options.compactness *= variant.compactness;
  options.room = variant.room;
  options.chamfer_axis = variant.chamfer_axis;
  options.gradual = variant.gradual;
  options.facing = variant.facing;
  options.strictness = variant.strictness;
  options.widest_bend = variant.widest_bend;
  options.narrow_regions = variant.narrow_regions;
  result.labelling = label(model_, result.mesh, options, monitor_, &result.report);
  result.faults = result.report.score;
  for (const FeatureEdge& e : find_features(model_, result.mesh, result.labelling, left_out_, monitor_).edges)
    result.lost_features += e.capture == EdgeCapture::kLost;
  result.smooth_corners = smooth_corners(result.mesh, result.labelling.frame, result.labelling.label);
  monitor_.log("label: " + describe(variant) + ": score " + std::to_string(result.faults) + ", " + std::to_string(result.lost_features) +
               " edges without feature charts, " + std::to_string(result.smooth_corners.size()) + " corners where the part is smooth");
  made_.push_back(std::move(result));
  return made_.back();
}

std::vector<LabelVariant> LabelChoice::facing(const LabelVariant& like) const {
  std::vector<LabelVariant> list{{.facing = true}, {.facing = true, .gradual = false}, {.facing = true, .strictness = kLabelTuning.strict}};
  for (int f = 1; f < std::ssize(frames_); ++f) list.push_back({.frame = f, .facing = true});
  if (like.widest_bend == LabelVariant{}.widest_bend) return list;
  std::vector<LabelVariant> alike = list;
  for (LabelVariant& v : alike) v.widest_bend = like.widest_bend;
  list.insert(list.begin(), alike.begin(), alike.end());
  return list;
}

const std::vector<LabelVariant>& LabelChoice::order() {
  if (!order_.empty()) return order_;
  order_ = variants(choices_of(model_, mesh_, frames_));
  for (auto v = order_.begin(); v != order_.end();) {
    const std::ptrdiff_t alike = has_twin(v, order_.end()) ? 2 : 1;
    const Labelled& first = labelled(*v);
    const bool settled = alike == 1 || (first.faults == 0 && first.lost_features == 0);
    const Labelled& other = settled ? first : labelled(v[1]);
    if (first.faults > 0 && other.faults > 0) {
      v += alike;
      continue;
    }
    if (better(other, first)) std::swap(v[0], v[1]);
    std::rotate(order_.begin(), v, v + alike);
    // Where there is nothing to repair other ways of repair would bring the same.
    std::stable_partition(order_.begin() + alike, order_.end(), [](const LabelVariant& l) { return l == plain(l); });
    return order_;
  }
  std::stable_sort(order_.begin(), order_.end(), [&](const LabelVariant& a, const LabelVariant& b) { return better(labelled(a), labelled(b)); });
  // The same labels twice would take the place of others.
  std::vector<LabelVariant> again;
  for (auto v = order_.begin(); v != order_.end();) {
    if (std::none_of(order_.begin(), v, [&](const LabelVariant& earlier) { return same_labels(labelled(earlier), labelled(*v)); })) {
      ++v;
    } else {
      again.push_back(*v);
      v = order_.erase(v);
    }
  }
  order_.insert(order_.end(), again.begin(), again.end());
  return order_;
}

void LabelChoice::look_along_bend() {
  const Labelled& first = labelled(order().front());
  if (first.faults > 0) return;
  const BisectingFrame bisecting = bisecting_frame(first.mesh, first.labelling, first.smooth_corners);
  if (!bisecting.frame || kLabelTuning.bent_corners * static_cast<double>(first.smooth_corners.size()) > bisecting.of) return;
  frames_.push_back(*bisecting.frame);
  for (const double widest_bend : {LabelVariant{}.widest_bend, kLabelTuning.fillets_whole}) {
    const LabelVariant variant{.frame = static_cast<int>(std::ssize(frames_)) - 1, .widest_bend = widest_bend};
    const Labelled& l = labelled(variant);
    const auto gone = std::ssize(first.smooth_corners) - std::ssize(l.smooth_corners);
    if (l.faults > 0 || l.lost_features > first.lost_features || 2 * gone < bisecting.of) continue;
    along_bend_ = variant;
    return;
  }
}

const std::optional<LabelVariant>& LabelChoice::along_bend() {
  if (more_frames_) look_along_bend();
  more_frames_ = false;
  return along_bend_;
}

}  // namespace polycube
