// Solids that touch in one mesh with common nodes.
#pragma once

#include "cad/conformal.h"
#include "core/monitor.h"
#include "core/report.h"
#include "fem/fem.h"

namespace polycube {

struct ConformalMesh {
  FemMesh fem;                       ///< groups by the numbers of the assembly
  std::vector<SolidReport> reports;  ///< per solid of the model
};

/// `options` are those of the whole assembly, `size` the edge length where a solid has none of its own. Throws StageFailed: of a stage, or of "interfaces"
/// where common nodes are not possible. InvalidInput for demands that only solids by themselves can be held to.
ConformalMesh mesh_conformally(const ConformalModel& model, const Assembly& assembly, const MeshOptions& options, const Monitor& monitor);

}  // namespace polycube
