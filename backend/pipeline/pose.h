// One pose for a part however it is turned, moved and scaled: meshes must not depend on that.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "core/options.h"

namespace polycube {

/// The part as the stages see it: axes of its frame along x, y, z, longest first, directed by its own shape, of fixed volume, rounded so that
/// equal parts in different poses become the same to the last bit. p -> scale * rotation * p + translation leads there.
struct Pose {
  CadModel model;  ///< posed
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();
  double scale = 1;
  Mat3 frame = Mat3::Identity();       ///< of the labels, in the pose
  Mat3 user_frame = Mat3::Identity();  ///< of the labels as the user sees them (given, or find_frame), in the part as given
  std::array<int, 3> axis{0, 1, 2};    ///< per axis of `frame`: the user's axis along it
  std::array<int, 3> sign{1, 1, 1};    ///< +1: the same way, -1: against it
  bool frame_given = false;            ///< by the user

  Vec3 back(const Vec3& p) const { return rotation.transpose() * (p - translation) / scale; }
  int posed_label(int user_label) const;
  int user_label(int posed_label) const;
  /// Coordinates of the map, and values of charts on `posed_axis`: from the pose to the part as given, in the user's axes.
  double map_back(int posed_axis, double value) const;
  Vec3 map_back(const Vec3& image) const;
  /// Throws InvalidInput, in the user's axes, where a face cannot have its label; mesh and labels are those of the pose.
  void check_labels(const TetMesh& mesh, const FaceLabels& labels) const;
  /// The chart's axis, sign and value in the user's axes.
  void map_back(Chart& chart) const;
  /// Of the labels, in the pose, best first: `frame`, and others of the part where the user does not speak of axes.
  std::vector<Mat3> frames(const MeshOptions& options) const;
  /// Whether the part may be labelled in other frames: where the user speaks of no axis.
  bool may_turn(const MeshOptions& options) const;
  /// A frame of the pose, as the user sees it.
  Mat3 user_axes(const Mat3& posed_frame) const;
  /// Lengths and labels in the pose, whose own frame is the one.
  MeshOptions posed(const MeshOptions& options) const;
};

/// Where OCCT cannot pose the part, it is left as it is. `axes` as in MeshOptions::frame.
Pose canonical_pose(const CadModel& model, const FrameAxes& axes = {});

/// Takes a mesh of the pose to the part as given: every boundary node exactly on its vertex, edge or nearest face of its patch there.
/// Throws StageFailed when an entity is not where the pose says.
void restore(const Pose& pose, const CadModel& model, const Association& association, HexMesh& mesh, const Monitor& monitor);

}  // namespace polycube
