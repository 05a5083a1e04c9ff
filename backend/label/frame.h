// The orthogonal frame a part was drawn in, and whether the user's labels fit it.
#pragma once

#include <vector>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/options.h"

namespace polycube {

/// Rows are right-handed unit axes. Directions of planar faces and of axes of cylinders, cones and extrusions vote with their area; the
/// orthogonal triple that most area agrees with wins. Axes are ordered and signed to be as near to the model's x, y, z as they can.
Mat3 find_frame(const CadModel& model);

/// Radians by which one frame has to turn until its axes are those of the other, in any order and direction.
double frame_turn(const Mat3& a, const Mat3& b);

/// Up to `most` frames that differ by more than 6 degrees, best first; the first is find_frame's.
std::vector<Mat3> find_frames(const CadModel& model, std::size_t most);

/// Throws InvalidInput, one line naming the face and the labels that it can have, where a face cannot get the label wanted: some of it has to face that
/// way (within 85 degrees) and nothing of it the other way (beyond 100 degrees), or the map would turn it inside out.
/// `to_frame` takes directions of the mesh to the frame of the labels.
void check_labels(const TetMesh& mesh, const Mat3& to_frame, const FaceLabels& labels);

}  // namespace polycube
