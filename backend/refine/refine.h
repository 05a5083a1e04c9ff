// Cells of a region divided 1:3, with templates between them and the cells that stay: all hexahedra, no hanging nodes.
#pragma once

#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

struct RefineRegion {
  std::vector<char> cells{};     ///< per hex: every edge of it is to be divided
  std::vector<Segment> along{};  ///< if not empty, edges are divided only in the sheets that these mesh edges cross
};

struct RefinedMesh {
  HexMesh mesh;  ///< nodes of the mesh before keep number and place
  Association association;
  std::vector<int> parent;  ///< per hex: that of the mesh before which it is a part of; ascending
  int grown = 0;            ///< cells that were divided along every edge though they were not of the region
};

/// Per hex whether it stands on the CAD entity: with a quad on a face, an edge on an edge, a node on a vertex; all of a solid.
std::vector<char> cells_at(const HexMesh& mesh, const Association& association, const CadRef& entity);

/// These cells, and all that share a node with one of them.
std::vector<char> with_neighbours(const HexMesh& mesh, const std::vector<char>& cells);

/// Divides the cells of the region, and those that have to be for the others to have a template. New nodes stand on the straight lines and faces of the cells
/// before; those on quads and segments have their CAD entity, but are not projected: fit follows. The mesh has to be one that check() of padding finds nothing
/// wrong with, and so has the result; quads may
/// also lie between two cells (of two solids), each as the cell sees it that it looks away from. Throws InvalidInput where it would have more than kMostHexes
/// cells.
RefinedMesh refine_cells(const HexMesh& mesh, const Association& association, const RefineRegion& region, const Monitor& monitor);

}  // namespace polycube
