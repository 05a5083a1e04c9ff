// Room for CAD edges at a vertex whose node has too few mesh edges: a corner of the grid has three, the tip of a pyramid needs four.
#pragma once

#include "core/mesh.h"

namespace polycube {

/// A boundary quad at the node of a CAD vertex, between whose two edges there a CAD edge more has to leave the node.
struct CrowdedCorner {
  int node = 0;
  int quad = 0;
};

/// The boundary of a hex mesh with what the hex stage knows of each quad.
struct RoomySurface {
  std::vector<Quad>& quads;
  std::vector<int>& quad_chart;
  std::vector<int>& quad_triangle;
};

/// Divides the quad into two at the node, by a layer round a few hexes under it that is open towards the quad's side. Quads and hexes keep
/// their numbers, new ones are appended with the chart and triangle of the quad beside them. Returns the number of new hexes, 0 where the
/// layer cannot be made.
int make_room(HexMesh& mesh, RoomySurface surface, const CrowdedCorner& corner);

}  // namespace polycube
