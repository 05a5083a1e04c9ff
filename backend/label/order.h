// The order that a labelling asks of its charts.
#pragma once

#include <vector>

#include "label/regions.h"

namespace polycube {

/// Charts of one axis each of which has to lie beyond the one before it, and the first beyond the last. A sign that no map has that, not a proof: where
/// boundaries wind about the axis one may exist. A ramp round a hole, flat in the image, whose ends a step joins is the shortest, one chart.
struct RisingLoop {
  int axis = 0;
  std::vector<int> charts;  ///< regions of the graph; empty: there is none
};

/// `graph`: of charts as regions. `points`: in the frame of the labels. A boundary that runs one way along its axis (reversals below `noise`, mm) puts the
/// charts at one end beyond those at the other; charts that share a corner are on one plane. Of all loops one of the shortest.
RisingLoop find_rising_loop(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& region_label, double noise);

/// Of labels per triangle; the loop's charts are numbered as find_charts numbers them.
RisingLoop find_rising_loop(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels);

}  // namespace polycube
