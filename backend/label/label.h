// One of six directions for every boundary triangle: a polycube labelling.
#pragma once

#include <string>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

struct LabelOptions {
  double fidelity = 3;                              ///< weight of agreeing with the normal
  double compactness = 1;                           ///< weight of short chart boundaries
  std::vector<std::pair<int, int>> face_labels;     ///< (CAD face, label 0..5) given by the user
  bool frame_given = false;
  Mat3 frame = Mat3::Identity();                    ///< rows: the axes, right-handed
};

struct Labelling {
  Mat3 frame = Mat3::Identity();  ///< rows: the axes of the labels in model space
  std::vector<int> label;         ///< per boundary triangle: 0..5 = +X -X +Y -Y +Z -Z of the frame
};

/// Throws StageFailed("label", ...) where no labelling passes `check`.
Labelling label(const CadModel& model, const TetMesh& mesh, const LabelOptions& options, const Monitor& monitor);

}  // namespace polycube
