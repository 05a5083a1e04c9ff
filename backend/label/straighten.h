// Chart boundaries inside smooth faces made straight, by cutting the tet mesh along them.
#pragma once

#include <functional>
#include <limits>

#include "core/monitor.h"
#include "label/regions.h"

namespace polycube {

/// A function on the mesh points of one CAD face that is positive in one region and negative in another; their border belongs at zero.
struct BorderFunction {
  int positive = 0, negative = 0;    ///< regions
  std::function<double(int)> value;  ///< per mesh point; kNoOpinion far from the border
  std::vector<int> ends{};           ///< mesh points where the border between the regions ends
};

inline constexpr double kNoOpinion = std::numeric_limits<double>::infinity();

/// Cuts the mesh along the zeros of the functions, in their order, and gives the triangles of the two regions by sign. Points within a fifth of an edge of
/// a border are put on it, unless that would turn a tet inside out. A border that ends on a CAD vertex goes there, one that ends on a CAD edge where another
/// has ended before goes where that one did after its cut. Returns the region of every triangle of the changed mesh.
std::vector<int> cut_along(TetMesh& mesh, const std::vector<int>& triangle_region, const std::vector<BorderFunction>& borders, const Monitor& monitor);

/// Splits surface edges inside a chart whose two ends the charts tie to one line: such an edge, and the triangles beside it, would have no room in
/// the image. `labels` per triangle is extended.
void split_tied_edges(TetMesh& mesh, std::vector<int>& labels, const Monitor& monitor);

}  // namespace polycube
