// Rings of hexahedra round bores and under the sides of solid cylinders, as an engineer draws them.
#pragma once

#include <vector>

#include "core/monitor.h"
#include "pad/pad.h"

namespace polycube {

struct RingOptions {
  std::size_t grid_cells = 0;     ///< the first hexes of the mesh, which are the grid's
  bool radial = true;             ///< tubes may get rings alone, from the bore to the outside, with fewer cells round the outside
  double longest = 0;             ///< how long cells round the outside of such a tube may be; 0: as they come
  std::vector<int> left_edges{};  ///< CAD edges, ascending, of bores that get none
};

/// Lays rings round every bore that has room for them, and divides the layer under the side of every solid cylinder so that the square of cells inside spans
/// about half of it. Where none of it can be done the mesh stays as it is. New nodes and those about them are spread evenly across the axis. The number of
/// bores and cylinders that got rings.
int insert_concentric(const CadModel& model, PaddedMesh& padded, const RingOptions& options, const Monitor& monitor);

/// Quads on cylinders that cut them off: two of their nodes are more than 120 degrees round from each other. The fit of a layer may end in such a mesh, whose
/// cells are good and whose surface is not the part's.
int count_cut_offs(const CadModel& model, const PaddedMesh& padded);

}  // namespace polycube
