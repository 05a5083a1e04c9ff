#include "label/frame.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/charts.h"
#include "core/error.h"
#include "label/tuning.h"

namespace polycube {
namespace {

struct Vote {
  Vec3 direction;
  double weight;
};

// Directions up to sign, those within a thousandth of a radian gathered into one.
std::vector<Vote> collect_votes(const CadModel& model) {
  std::vector<Vote> votes;
  for (const int f : model.faces()) {
    const CadFace& face = model.face(f);
    if (face.axis.squaredNorm() < 0.5) continue;
    // The axis of a curved face fixes one direction only, as a plane does; curved faces count less so that a big barrel does not
    // outvote the planes beside it.
    const double weight = face.area * (face.kind == SurfaceKind::kPlane ? 1.0 : 0.5);
    auto same = std::find_if(votes.begin(), votes.end(), [&](const Vote& v) { return std::abs(v.direction.dot(face.axis)) > 1 - 1e-6; });
    if (same != votes.end()) {
      same->weight += weight;
    } else {
      votes.push_back({face.axis.normalized(), weight});
    }
  }
  std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) { return a.weight > b.weight * (1 + 1e-9); });
  return votes;
}

double score(const Mat3& frame, const std::vector<Vote>& votes) {
  double sum = 0;
  for (const Vote& v : votes) {
    const double cosine = (frame * v.direction).cwiseAbs().maxCoeff();
    sum += v.weight * std::exp(-(1 - cosine) / 0.01);
  }
  return sum;
}

// Of the 24 right-handed orders and signs of the axes the one nearest to the identity.
Mat3 nearest_to_world(const Mat3& frame) {
  Mat3 best = frame;
  double best_trace = -10;
  std::array<int, 3> order{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs) {
      Mat3 candidate;
      for (int k = 0; k < 3; ++k) candidate.row(k) = (signs >> k & 1 ? -1.0 : 1.0) * frame.row(order[k]);
      if (candidate.determinant() < 0 || candidate.trace() <= best_trace + 1e-9) continue;
      best_trace = candidate.trace();
      best = candidate;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

// A direction across `axis` that turns with the part: to the CAD vertex furthest from the axis through the box of vertices.
Vec3 direction_across(const CadModel& model, const Vec3& axis) {
  Vec3 centre = Vec3::Zero();
  double area = 0;
  for (const int f : model.faces()) {
    centre += model.face(f).area * model.face(f).centre;
    area += model.face(f).area;
  }
  centre /= area;
  Vec3 best = Vec3::Zero();
  for (const int v : model.vertices()) {
    const Vec3 arm = model.vertex(v) - centre;
    const Vec3 across = arm - arm.dot(axis) * axis;
    if (across.norm() > best.norm() * (1 + 1e-6) + 1e-6 * model.diagonal()) best = across;
  }
  if (best.norm() > 1e-3 * model.diagonal()) return best.normalized();
  return axis.unitOrthogonal();
}

// For a part without any direction of its own, as a sphere: from its first CAD vertex to the one furthest from it, which turns with the part.
Mat3 frame_of_vertices(const CadModel& model) {
  if (model.vertices().empty()) return Mat3::Identity();
  const Vec3& start = model.vertex(model.vertices().front());
  Vec3 a = Vec3::Zero();
  for (const int v : model.vertices()) {
    const Vec3 arm = model.vertex(v) - start;
    if (arm.norm() > a.norm() * (1 + 1e-6)) a = arm;
  }
  if (a.norm() < 1e-3 * model.diagonal()) return Mat3::Identity();
  a.normalize();
  Vec3 b = a.unitOrthogonal();
  double furthest = 1e-3 * model.diagonal();
  for (const int e : model.edges()) {
    for (const Vec3& p : model.edge_samples(e, 5)) {
      const Vec3 arm = p - start, across = arm - arm.dot(a) * a;
      if (across.norm() <= furthest * (1 + 1e-6)) continue;
      furthest = across.norm();
      b = across.normalized();
    }
  }
  Mat3 frame;
  frame.row(0) = a;
  frame.row(1) = b;
  frame.row(2) = a.cross(b);
  return nearest_to_world(frame);
}

/// Least and largest cosine between a face's normals and the six labels.
struct Spread {
  std::array<double, 6> least, most;
  bool towards(int label) const { return most[label] > kLabelTuning.towards; }
  bool possible(int label) const { return towards(label) && least[label] > kLabelTuning.against; }
};

Spread spread_of(const TetMesh& mesh, const Mat3& to_frame, int face) {
  Spread spread;
  spread.least.fill(1);
  spread.most.fill(-1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_face[t] != face) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 n = to_frame * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).normalized();
    for (int label = 0; label < 6; ++label) {
      const double cosine = label_sign(label) * n[label_axis(label)];
      spread.least[label] = std::min(spread.least[label], cosine);
      spread.most[label] = std::max(spread.most[label], cosine);
    }
  }
  return spread;
}

}  // namespace

void check_labels(const TetMesh& mesh, const Mat3& to_frame, const FaceLabels& labels) {
  for (const auto& [face, label] : labels) {
    const Spread spread = spread_of(mesh, to_frame, face);
    if (spread.possible(label)) continue;
    std::string can;
    for (int l = 0; l < 6; ++l) {
      if (spread.possible(l)) can += (can.empty() ? "it can be " : " or ") + std::string(label_name(l));
    }
    const std::string wanted = label_name(label);
    throw InvalidInput("--label: " + name({2, face}) + " cannot be " + wanted +
                       (spread.towards(label) ? " all over, it turns against it" : ", it does not face that way") + "; " +
                       (can.empty() ? "it turns too far for any one label" : can));
  }
}

double frame_turn(const Mat3& a, const Mat3& b) {
  const Mat3 turn = a * b.transpose();
  return std::acos(std::clamp((nearest_to_world(turn).trace() - 1) / 2, -1.0, 1.0));
}

std::vector<Mat3> find_frames(const CadModel& model, std::size_t most) {
  const std::vector<Vote> votes = collect_votes(model);
  if (votes.empty()) return {frame_of_vertices(model)};
  std::vector<std::pair<double, Mat3>> triples;
  const std::size_t tried = std::min<std::size_t>(votes.size(), 24);
  for (std::size_t i = 0; i < tried; ++i) {
    const Vec3 a = votes[i].direction;
    std::vector<Vec3> seconds;
    for (std::size_t j = 0; j < tried; ++j) {
      const Vec3 across = votes[j].direction - votes[j].direction.dot(a) * a;
      if (across.norm() > 0.1) seconds.push_back(across.normalized());
    }
    if (seconds.empty()) seconds.push_back(direction_across(model, a));
    for (const Vec3& b : seconds) {
      Mat3 frame;
      frame.row(0) = a;
      frame.row(1) = b;
      frame.row(2) = a.cross(b);
      triples.emplace_back(score(frame, votes), frame);
    }
  }
  std::vector<Mat3> frames;
  while (frames.size() < most) {
    // Of equals the first.
    const std::pair<double, Mat3>* best = nullptr;
    for (const auto& triple : triples) {
      if (std::any_of(frames.begin(), frames.end(), [&](const Mat3& f) { return frame_turn(f, triple.second) < kLabelTuning.same_frame; })) continue;
      if (!best || triple.first > best->first * (1 + 1e-9)) best = &triple;
    }
    if (!best) break;
    frames.push_back(nearest_to_world(best->second));
  }
  return frames;
}

BisectingFrame bisecting_frame(const TetMesh& mesh, const Labelling& labelling, const std::vector<int>& corners) {
  struct Bend {
    std::set<int> labels;
    Vec3 sum = Vec3::Zero();     // of the normals, by area
    Mat3 spread = Mat3::Zero();  // of their products
    double area = 0;
    std::set<int> corners;
  };
  const std::set<int> is_corner(corners.begin(), corners.end());
  std::map<int, Bend> bends;  // by CAD face
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 w = (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    const double area = w.norm();
    if (!(area > 0)) continue;
    Bend& bend = bends[mesh.triangle_face[t]];
    bend.labels.insert(labelling.label[t]);
    bend.sum += w;
    bend.spread += w * w.transpose() / area;
    bend.area += area;
    for (const int n : mesh.triangles[t]) {
      if (is_corner.contains(n)) bend.corners.insert(n);
    }
  }
  std::vector<std::pair<Mat3, std::set<int>>> votes;
  std::set<int> all;
  for (const auto& [face, bend] : bends) {
    if (bend.labels.size() < 2 || bend.sum.norm() < kLabelTuning.bisected * bend.area) continue;
    const Eigen::SelfAdjointEigenSolver<Mat3> normals(bend.spread / bend.area);
    // Where normals turn about more than one axis none is that of the bend, and those of a plane turn about none.
    if (normals.eigenvalues()[0] > kLabelTuning.off_plane || normals.eigenvalues()[1] < kLabelTuning.off_plane) continue;
    all.insert(bend.corners.begin(), bend.corners.end());
    Mat3 frame;
    frame.row(0) = normals.eigenvectors().col(0);
    frame.row(1) = (bend.sum - bend.sum.dot(frame.row(0)) * frame.row(0).transpose()).normalized();
    frame.row(2) = frame.row(0).cross(frame.row(1));
    if (frame_turn(frame, labelling.frame) < kLabelTuning.same_frame) continue;
    auto same = std::find_if(votes.begin(), votes.end(), [&](const auto& v) { return frame_turn(frame, v.first) < kLabelTuning.same_frame; });
    if (same == votes.end()) same = votes.insert(votes.end(), {nearest_to_world(frame), {}});
    same->second.insert(bend.corners.begin(), bend.corners.end());
  }
  BisectingFrame result{std::nullopt, static_cast<int>(all.size())};
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (most != votes.end() && !most->second.empty() && 2 * most->second.size() >= all.size()) result.frame = most->first;
  return result;
}

Mat3 find_frame(const CadModel& model) { return find_frames(model, 1).front(); }

}  // namespace polycube
