// What a mesh must be to be handed out.
#pragma once

#include "cad/cad.h"
#include "core/monitor.h"
#include "pad/pad.h"

namespace polycube {

/// Inverted, or with an edge of no length.
bool is_faulty(const CadModel& model, const HexMesh& mesh, const Hex& hex);

/// Nothing passes that is not a conforming mesh of positive cells with the surface of the solid, of which solvers' elements can be made. Throws StageFailed.
/// `threads` as in MeshOptions.
void gate(const CadModel& model, const PaddedMesh& padded, int threads, const Monitor& monitor);

}  // namespace polycube
