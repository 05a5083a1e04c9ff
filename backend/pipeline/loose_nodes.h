#pragma once

#include "cad/cad.h"
#include "core/mesh.h"

namespace polycube {

/// The nodes on CAD edges that stand more than FreeCAD's 1e-7 mm off a face of their edge: files with loose tolerances have edges whose curve leaves the
/// surfaces it bounds, and no place is on all three.
int count_loose_nodes(const CadModel& model, const Association& association, const std::vector<Vec3>& points);

}  // namespace polycube
