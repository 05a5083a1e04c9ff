// Tetrahedral mesh of a CAD solid by Gmsh, in a child process with a time limit and a ladder of settings.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "tet/tuning.h"

namespace polycube {

struct TetOptions {
  double size = 0;                          ///< target edge length, mm
  double curvature = kTetTuning.curvature;  ///< elements per full circle that curved faces and edges get at least (finer than size where needed); 0: off
  double attempt_limit = kTetTuning.attempt_limit;  ///< seconds of processor time of one setting, not of the clock: a busy machine gives the same mesh
};

/// Tets with every boundary node, edge and triangle classified. No tet has more than one boundary facet and no inner edge joins two boundary points
/// (such tets and edges are split). Throws StageFailed("tet", ...) when every setting fails.
TetMesh tetrahedralise(const CadModel& model, const TetOptions& options, const Monitor& monitor);

/// The same of several solids that share faces, in one mesh: `whole` has the entities of all, `solids` are in the order of TetMesh::tet_solid.
TetMesh tetrahedralise(const CadModel& whole, const std::vector<CadModel>& solids, const TetOptions& options, const Monitor& monitor);

/// What is wrong with a tet mesh of the model; empty when nothing is.
std::vector<std::string> check(const TetMesh& mesh);

}  // namespace polycube
