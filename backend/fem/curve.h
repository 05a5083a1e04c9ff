// Second order: a node in the middle of every mesh edge, on the CAD where the edge stands on it, and no cell spoilt by it. Private to fem.
#pragma once

#include "fem/fem.h"

namespace polycube {

/// Adds the mid-edge nodes of hexes, quads and segments to a mesh of corners, and counts the edges that had to be left straight.
void add_mid_nodes(const CadModel& model, FemMesh& mesh, const FemOptions& options, const Monitor& monitor);

}  // namespace polycube
