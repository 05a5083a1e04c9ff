#include "pipeline/pose.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "label/frame.h"
#include "label/tuning.h"
#include "pipeline/tuning.h"

namespace polycube {
namespace {

double nine_digits(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 8);
  return std::round(value / digit) * digit;
}

std::vector<Vec3> points_of(const CadModel& model) {
  std::vector<Vec3> points;
  for (const int v : model.vertices()) points.push_back(model.vertex(v));
  for (const int e : model.edges()) {
    for (const Vec3& p : model.edge_samples(e, kPipelineTuning.pose_samples)) points.push_back(p);
  }
  return points;
}

// The frame with its axes in the order of the part's extents, directed by where the part has its entities. Entities count by their numbers, which
// tells apart what is symmetric and moves with the part.
Mat3 directed(const Mat3& frame, const std::vector<Vec3>& points, const Vec3& centre) {
  std::array<double, 3> extent{}, moment{};
  for (int k = 0; k < 3; ++k) {
    double low = 0, high = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = frame.row(k).dot(points[i] - centre);
      low = std::min(low, x);
      high = std::max(high, x);
      const double golden = 0.6180339887498949 * static_cast<double>(i + 1);
      moment[k] += (golden - std::floor(golden)) * x;
    }
    extent[k] = high - low;
  }
  const double tie = kPipelineTuning.tie * *std::max_element(extent.begin(), extent.end());
  const auto before = [&](int a, int b) {
    return std::abs(extent[a] - extent[b]) > tie ? extent[a] > extent[b] : std::abs(moment[a]) > std::abs(moment[b]) + tie;
  };
  std::array<int, 3> order{0, 1, 2};
  // Three numbers; a sort of the library would want an order without ties that are not transitive.
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
    if (before(order[j], order[i])) std::swap(order[i], order[j]);
  }
  Mat3 result;
  for (int k = 0; k < 3; ++k) result.row(k) = (moment[order[k]] < -tie ? -1.0 : 1.0) * frame.row(order[k]);
  if (result.determinant() < 0) result.row(2) *= -1;
  return result;
}

}  // namespace

int Pose::posed_label(int user_label) const {
  const auto at = static_cast<int>(std::find(axis.begin(), axis.end(), user_label / 2) - axis.begin());
  return 2 * at + (sign[at] > 0 ? user_label % 2 : 1 - user_label % 2);
}

int Pose::user_label(int posed_label) const { return 2 * axis[posed_label / 2] + (sign[posed_label / 2] > 0 ? posed_label % 2 : 1 - posed_label % 2); }

double Pose::map_back(int posed_axis, double value) const { return sign[posed_axis] * (value - translation[posed_axis]) / scale; }

Vec3 Pose::map_back(const Vec3& image) const {
  Vec3 result;
  for (int k = 0; k < 3; ++k) result[axis[k]] = map_back(k, image[k]);
  return result;
}

void Pose::map_back(Chart& chart) const {
  chart.value = map_back(chart.axis, chart.value);
  chart.sign *= sign[chart.axis];
  chart.axis = axis[chart.axis];
}

void Pose::check_labels(const TetMesh& mesh, const FaceLabels& labels) const {
  FaceLabels user = labels;
  for (auto& [face, label] : user) label = user_label(label);
  polycube::check_labels(mesh, user_frame * rotation.transpose(), user);
}

bool Pose::may_turn(const MeshOptions& options) const {
  const bool by_axis = std::any_of(options.sizes.begin(), options.sizes.end(), [](const LocalSize& s) { return s.face == 0; });
  return !frame_given && !by_axis && options.labels.empty();
}

std::vector<Mat3> Pose::frames(const MeshOptions& options) const {
  std::vector<Mat3> result{frame};
  if (!may_turn(options)) return result;
  for (const Mat3& f : find_frames(model, kPipelineTuning.frames)) {
    if (frame_turn(f, frame) > kLabelTuning.same_frame) result.push_back(f);
  }
  return result;
}

Mat3 Pose::user_axes(const Mat3& posed_frame) const {
  const Mat3 turned = posed_frame * rotation;
  Mat3 result;
  for (int k = 0; k < 3; ++k) result.row(axis[k]) = sign[k] * turned.row(k);
  return result;
}

MeshOptions Pose::posed(const MeshOptions& options) const {
  MeshOptions result = options;
  // The same size in the pose has to be the same to the last bit too.
  for (double* length : {&result.size, &result.max_size}) *length = *length > 0 ? nine_digits(*length * scale) : 0;
  for (auto& [face, label] : result.labels) label = posed_label(label);
  result.frame.clear();
  for (LocalSize& s : result.sizes) {
    s.size = nine_digits(s.size * scale);
    if (s.face == 0) s.axis = static_cast<int>(std::find(axis.begin(), axis.end(), s.axis) - axis.begin());
  }
  return result;
}

Pose canonical_pose(const CadModel& model, const FrameAxes& axes) {
  Pose pose{model};
  pose.frame_given = !axes.empty();
  pose.user_frame = axes.empty() ? find_frame(model) : frame_of(axes);
  pose.frame = pose.user_frame;
  const std::vector<Vec3> points = points_of(model);
  if (points.empty()) return pose;
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : points) centre += p / static_cast<double>(points.size());
  const Mat3 rotation = directed(pose.user_frame, points, centre);
  const double scale = nine_digits(kPipelineTuning.posed_size / std::cbrt(model.volume()));
  const Vec3 translation = -scale * (rotation * centre);
  for (const double grid : {kPipelineTuning.grid, kPipelineTuning.grid / 100, 0.0}) {
    try {
      pose.model = model.transformed(rotation, translation, scale, grid);
    } catch (const InvalidInput&) {
      continue;
    }
    pose.rotation = rotation;
    pose.translation = translation;
    pose.scale = scale;
    pose.frame = Mat3::Identity();
    const Mat3 turn = rotation * pose.user_frame.transpose();
    for (int k = 0; k < 3; ++k) {
      turn.row(k).cwiseAbs().maxCoeff(&pose.axis[k]);
      pose.sign[k] = turn(k, pose.axis[k]) < 0 ? -1 : 1;
    }
    break;
  }
  return pose;
}

void restore(const Pose& pose, const CadModel& model, const Association& association, HexMesh& mesh, const Monitor& monitor) {
  const double reach = 1e-5 * model.diagonal();
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    if (n % 256 == 0) monitor.check();
    Vec3& p = mesh.points[n];
    p = pose.back(p);
    const CadRef& cad = association.point_cad[n];
    if (cad.dim == 3) continue;
    Vec3 on = p;
    double distance = 0;
    if (cad.dim == 0) {
      on = model.vertex(cad.id);
      distance = (on - p).norm();
    } else if (cad.dim == 1) {
      const EdgePoint foot = model.project_to_edge(cad.id, p);
      on = foot.point;
      distance = foot.distance;
    } else {
      distance = std::numeric_limits<double>::infinity();
      for (const int f : association.patches[cad.id]) {
        const FacePoint foot = model.project_to_face(f, p);
        if (foot.distance < distance) {
          distance = foot.distance;
          on = foot.point;
        }
      }
    }
    if (!(distance <= reach)) throw StageFailed("fit", "a node is off its CAD entity", cad.dim == 2 ? std::vector<CadRef>{} : std::vector<CadRef>{cad});
    p = on;
  }
}

}  // namespace polycube
