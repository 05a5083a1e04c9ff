// The CAD's angles at the edges and nodes of the boundary, and what it costs to fill them with a given number of cells.
#pragma once

#include "pad/pad.h"
#include "pad/topology.h"

namespace polycube {

/// Cost of dividing an angle (radians) among `cells` cells: 0 at 90 degrees each, growing as their best possible scaled Jacobian falls, at
/// least 1000 where a cell would have to span 150 degrees or more.
double angle_cost(int cells, double angle);

/// Interior dihedral angle of the CAD at each boundary edge, radians: pi where both quads lie on one patch without a CAD edge between. `wanted`: only at edges
/// with such a node, pi elsewhere; empty for all.
std::vector<double> dihedral_angles(const CadModel& model, const HexMesh& mesh, const Association& association, const std::vector<BoundaryEdge>& edges,
                                    const std::vector<char>& wanted = {});

/// Consecutive boundary quads round a node between two CAD edges.
struct Sector {
  int node;
  int patch;
  int first,
      last;      ///< the neighbours of the node on the CAD edges that bound it, counter-clockwise seen from outside; -1 if there is no CAD edge
  int quads;     ///< how many
  double angle;  ///< of the CAD between the two edges, radians; 2 pi without an edge
};

/// The sectors at all nodes for which `wanted` is set and which the listed quads surround completely, by node.
std::vector<Sector> find_sectors(const CadModel& model, const HexMesh& mesh, const Association& association, const std::vector<char>& wanted);

/// What the corners of hexes at the wanted nodes cost whose two sides are CAD edges with an inner face between them: no move of nodes changes
/// their angle, and no sector tells of them. So do those that touch a smooth patch along two edges alone.
double inner_corner_cost(const CadModel& model, const HexMesh& mesh, const Association& association, const HexTopology& topology,
                         const std::vector<char>& wanted);

}  // namespace polycube
