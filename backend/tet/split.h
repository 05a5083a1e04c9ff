// Splits that give a polycube map room to move.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

/// Splits, in this order: surface edges that cut a corner between two nodes of one CAD edge (such a triangle would collapse when the nodes
/// share a coordinate), inner edges between boundary points, inner facets between boundary points. Afterwards every tet has a point inside, so at most one
/// boundary facet. Volumes stay positive; new surface nodes lie on their CAD face.
void split_for_map(TetMesh& mesh, const CadModel& model, const Monitor& monitor);

}  // namespace polycube
