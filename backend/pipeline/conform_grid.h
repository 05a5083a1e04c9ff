// Grids of hexahedra through several solids, and the part of each solid in them.
#pragma once

#include "blocks/blocks.h"
#include "cad/conformal.h"
#include "core/monitor.h"
#include "hex/hex.h"
#include "pad/pad.h"
#include "quantize/quantize.h"

namespace polycube {

/// Per block the index of its solid. Throws StageFailed("interfaces", ...) where an interface does not part the blocks.
std::vector<int> solids_of_blocks(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks);

/// Interfaces bound the blocks on both sides as charts do: their vertices take part in C2.
void bound_at_interfaces(BlockComplex& blocks, const PolycuboidMap& map, const std::vector<int>& block_solid);

/// The walls between interfaces, and between these and outer charts, get an element at least, and by solid as many as `layers` says; those may yield where
/// `may_yield` says so.
std::vector<DistanceConstraint> walls_of_solids(const BlockComplex& blocks, const std::vector<int>& block_solid, const std::vector<int>& layers,
                                                const std::vector<char>& may_yield);

/// What one solid has of a mesh.
struct SolidGrid {
  HexMesh mesh;
  std::vector<int> node;                       ///< per point: its number in the whole mesh
  std::vector<int> hex;                        ///< per hex: likewise
  std::vector<Quad> quads;                     ///< its boundary, outward; by its own points
  std::vector<int> quad_chart, quad_triangle;  ///< as in HexComplex, of the solid's own tets
};

/// `tets`: of the solid, its points in the whole mesh are `tet_points`; `own_charts`: charts_of_solid().
SolidGrid grid_of_solid(const HexComplex& hexes, const std::vector<int>& hex_solid, int solid, const TetMesh& tets, const std::vector<int>& tet_points,
                        const PolycuboidMap& map, const std::vector<Chart>& own_charts);

/// The map's charts with the triangles of the solid's own tets, those of interfaces too. `inner_chart`: per inner triangle of `tets` its chart among the last
/// ones of the map.
std::vector<Chart> charts_of_solid(const TetMesh& tets, const std::vector<int>& tet_points, const TetMesh& own, const PolycuboidMap& map,
                                   const std::vector<int>& inner_chart);

/// The solids' meshes, each associated with its own model, in one: nodes of interfaces once, numbered as `node` of the grids says for the first ones; what
/// padding added follows.
struct JoinedGrids {
  PaddedMesh whole;                    ///< quads of interfaces are listed once, as the first of their solids sees them
  std::vector<std::vector<int>> node;  ///< per solid and point of its mesh: the node of the whole
  std::vector<std::vector<int>> hex;   ///< per solid and hex of its mesh: the hex of the whole
};

/// Throws StageFailed("interfaces", ...) where two solids do not see their interface alike.
JoinedGrids join_grids(const ConformalModel& model, const std::vector<SolidGrid>& grids, const std::vector<PaddedMesh>& solids, std::size_t nodes);

/// A mesh of several solids, and what each has of it.
struct PaddedGrids {
  JoinedGrids joined;
  std::vector<PaddedMesh> solids;
  std::vector<int> added_hexes{};  ///< per solid, by padding
};

/// Takes a mesh of several solids apart. `hex_solid`: per hex the index of its solid; of the quads those between solids are listed once. What a solid has lost
/// is what it had lost in `before`.
PaddedGrids part_grids(const ConformalModel& model, PaddedMesh whole, const std::vector<int>& hex_solid, const std::vector<PaddedMesh>& before,
                       const Monitor& monitor);

/// Whether a padded mesh of a solid has left its interfaces as they were.
bool keeps_interfaces(const ConformalModel& model, const Association& before, const Association& after);

}  // namespace polycube
