// A sheet of hexahedra divided into several along its thickness, or taken out.
#pragma once

#include "pad/pad.h"
#include "pad/topology.h"

namespace polycube {

/// The hexes that lie side by side in one layer, with the axis (0 to 2) of each across the layer.
struct TracedSheet {
  std::vector<int> hexes;  ///< in the order in which they were found, the first first
  std::vector<int> axes;   ///< of each
  bool simple = true;      ///< it passes through no hex twice
};

/// The sheet that goes through a side of a hex, its thickness at right angles to that side.
TracedSheet trace_sheet(const HexMesh& mesh, const HexTopology& topology, int side);

/// Divides the hexes of a simple sheet into `parts` across it, evenly. Quads, segments and classes of the boundary are divided with them. Nodes and hexes keep
/// their numbers, new ones are appended.
void divide_sheet(PaddedMesh& padded, const TracedSheet& sheet, int parts);

/// Takes a simple sheet out: the nodes on its two sides become one. False, and the mesh as it was, where that would lose a CAD vertex or bring together what
/// stands on different CAD entities, or takes a mesh edge from a CAD edge that is not among `edges` (ascending). Nodes and hexes get other numbers; `origin` is
/// kept.
bool collapse_sheet(PaddedMesh& padded, const TracedSheet& sheet, const std::vector<int>& edges);

}  // namespace polycube
