// Enough cells along the polycube's edges for the CAD vertices on them.
#pragma once

#include "blocks/blocks.h"
#include "cad/cad.h"
#include "quantize/quantize.h"

namespace polycube {

/// CAD vertices need not be corners of the polycube: a Boolean operation leaves them where the seam of a barrel ends in the middle of an edge, a drawing where
/// a line goes on as an arc. Each needs a node of its own between the corners, or the association puts it beside the edge. One constraint for every stretch of
/// a polycube edge from chart to chart on which the two ends cannot hold them all: an end that is no CAD vertex itself may take one. `edge_chains`: tet mesh
/// points along every CAD edge, empty for those the mesh does without; `ignored`: per CAD edge number, as in AssociateOptions.
std::vector<DistanceConstraint> room_for_vertices(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                                  const std::vector<std::vector<int>>& edge_chains, const std::vector<char>& ignored);

}  // namespace polycube
