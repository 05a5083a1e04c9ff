// The nodes between which edges are divided.
#pragma once

#include "core/monitor.h"
#include "pad/topology.h"
#include "refine/templates.h"

namespace polycube {

/// The corners of a hex that are marked.
CornerSet marked_corners(const Hex& hex, const std::vector<char>& marked);

/// Per node whether it is marked: those of the cells, and as many more as it takes for every hex to have a template.
std::vector<char> marked_nodes(const HexMesh& mesh, const HexTopology& topology, const std::vector<char>& cells, const Monitor& monitor);

/// Per hex and direction whether its edges may be divided: they are in the same sheet as one of the mesh edges of `along`. All of them where it is empty.
std::vector<std::array<bool, 3>> divided_directions(const HexMesh& mesh, const std::vector<Segment>& along);

}  // namespace polycube
