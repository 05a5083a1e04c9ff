// The whole way from a CAD solid to a hexahedral mesh.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "core/report.h"

namespace polycube {

struct MeshResult {
  HexMesh mesh;  ///< valid: every scaled Jacobian > 0, conforming, the Euler characteristic of the solid
  /// Per hex: its block of the polycuboid's decomposition; of the coarsest mesh (MeshOptions::coarsest) the cell itself, padding as beside it.
  std::vector<int> hex_block;
  Association association;  ///< of `mesh`
  MeshReport report;        ///< complete but for what the element order adds (fem fills straightened_edges)
};

/// Meshes the model. The caller's monitor carries progress, cancel and deadline; options.time_limit is the caller's to turn into one.
/// Throws InvalidInput (options against this part), StageFailed (no candidate gave a valid mesh), Cancelled.
MeshResult mesh(const CadModel& model, const MeshOptions& options, const Monitor& monitor);

}  // namespace polycube
