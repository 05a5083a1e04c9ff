// First places: every boundary node on its CAD entity, chains in order along their curve, the rest carried along.
#pragma once

#include "core/monitor.h"
#include "fit/energy.h"

namespace polycube {

/// Puts vertices on vertices, spreads each CAD edge's chain along its curve (in order, spacing as it was but nowhere bunched), lets the nodes of
/// patches follow their border and projects them, then lets inner nodes follow the boundary.
void place_on_cad(const CadModel& model, HexMesh& mesh, const Association& association, Entities& entities, const Monitor& monitor);

}  // namespace polycube
