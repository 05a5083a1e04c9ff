// The orthogonal frame a part was drawn in, and whether the user's labels fit it.
#pragma once

#include <optional>
#include <vector>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/options.h"
#include "label/label.h"

namespace polycube {

/// Rows are right-handed unit axes. Directions of planar faces and of axes of cylinders, cones and extrusions vote with their area; the
/// orthogonal triple that most area agrees with wins. Axes are ordered and signed to be as near to the model's x, y, z as they can.
Mat3 find_frame(const CadModel& model);

/// Radians by which one frame has to turn until its axes are those of the other, in any order and direction.
double frame_turn(const Mat3& a, const Mat3& b);

/// Up to `most` frames that differ by more than 6 degrees, best first; the first is find_frame's.
std::vector<Mat3> find_frames(const CadModel& model, std::size_t most);

/// The frame in which most of `corners` (points of the mesh) would go that stand on bent faces which the labels divide: one axis along the mean normal of
/// such faces, one along the axis that they bend round, so that they may keep one label. `of`: how many of the corners stand on any such face. None where that
/// is the labelling's own frame, or fewer than half of them would go.
struct BisectingFrame {
  std::optional<Mat3> frame;
  int of = 0;
};
BisectingFrame bisecting_frame(const TetMesh& mesh, const Labelling& labelling, const std::vector<int>& corners);

/// Throws InvalidInput, one line naming the face and the labels that it can have, where a face cannot get the label wanted: some of it has to face that
/// way (within 85 degrees) and nothing of it the other way (beyond 100 degrees), or the map would turn it inside out.
/// `to_frame` takes directions of the mesh to the frame of the labels.
void check_labels(const TetMesh& mesh, const Mat3& to_frame, const FaceLabels& labels);

}  // namespace polycube
