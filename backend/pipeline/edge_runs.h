// CAD edges as they run along the axes of the map, and the cells that they need there.
#pragma once

#include "blocks/blocks.h"
#include "quantize/quantize.h"

namespace polycube {

/// A stretch of a CAD edge along one axis of the map, from one chart or feature to another.
struct EdgeRun {
  int axis = 0;
  int from = -1, to = -1;          ///< charts; -1 where the grid is free to stand anywhere on the stretch
  int from_node = 0, to_node = 0;  ///< of the tet mesh
  double length = 0;               ///< in the map
};

class EdgeRuns {
 public:
  /// Holds references.
  EdgeRuns(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks);

  /// `chain`: the edge's points in the tet mesh, in order; the first again at the end of a closed one.
  std::vector<EdgeRun> of(const std::vector<int>& chain) const;

 private:
  int unknown_at(int node, int axis) const;
  bool held(int a, int b, int axis) const;

  const PolycuboidMap& map_;
  const BlockComplex& blocks_;
  std::vector<std::array<std::vector<int>, 3>> charts_at_;  // per tet mesh point and axis
};

/// CAD edges that go on from each other in one direction have nothing in the map that keeps their common vertex apart from the ends (two semicircles of a
/// hole's rim, the lines from the tip of a drilled hole to its rim): as many cells as edges, at least, for the stretch from chart to chart.
std::vector<DistanceConstraint> room_for_edges(const std::vector<std::vector<int>>& chains, const TetMesh& tets, const PolycuboidMap& map,
                                               const BlockComplex& blocks);

}  // namespace polycube
