// The orthogonal frame a part was drawn in.
#pragma once

#include "cad/cad.h"

namespace polycube {

/// Rows are right-handed unit axes. Directions of planar faces and of axes of cylinders, cones and extrusions vote with their area; the
/// orthogonal triple that most area agrees with wins. Axes are ordered and signed to be as near to the model's x, y, z as they can.
Mat3 find_frame(const CadModel& model);

}  // namespace polycube
