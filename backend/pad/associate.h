// Association before geometry: which mesh node stands on which CAD vertex, edge, face.
#pragma once

#include <map>
#include <string>

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"
#include "pad/room.h"

namespace polycube {

/// The boundary of a hex mesh as the hex stage leaves it.
struct HexBoundary {
  const std::vector<Vec3>& points;  ///< first geometry, near the CAD surface for boundary nodes
  const std::vector<Quad>& quads;   ///< outward
  const std::vector<int>& quad_chart;
  const std::vector<int>& quad_triangle;  ///< a boundary triangle of the tet mesh near each quad
};

struct AssociateOptions {
  std::vector<std::vector<int>> edge_chains;  ///< per CAD edge number (entry 0 unused): tet mesh points along it, empty to leave the edge out
  double size = 0;                            ///< typical edge length, mm
  std::vector<char> ignored;                  ///< per CAD edge number: to be left out, and no loss; may be empty
  /// CAD edges that have their nodes already, from the first to the second vertex: on them a solid beside this one has been associated.
  std::map<int, std::vector<int>> given_paths{};
};

/// Chooses a node for every CAD vertex and a path of mesh edges for every CAD edge with a chain, such that the quads fall into one region per
/// patch with the topology of the patch. Edges for which that fails are given up (lost_edges) one by one.
/// `crowded`, if not null, gets the corners at which a CAD edge was lost because its vertex's node has no mesh edge left on that side, one a
/// vertex, for make_room.
/// Throws StageFailed("pad", ...) if not even the whole surface as one patch fits, which means the mesh's topology is wrong.
Association associate(const CadModel& model, const TetMesh& tets, const std::vector<Chart>& charts, const HexBoundary& boundary,
                      const AssociateOptions& options, const Monitor& monitor, std::vector<CrowdedCorner>* crowded = nullptr);

}  // namespace polycube
