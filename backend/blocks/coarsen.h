// Dropping sheets that touch no chart, on a complex cut along all of every plane (figure 9).
#pragma once

#include "blocks/blocks.h"

namespace polycube {

/// Per axis and side the plane of a block: index into SheetCuts::planes.
using BlockPlanes = std::array<std::array<int, 2>, 3>;

struct Coarse {
  std::vector<Block> blocks;        ///< without corners and tets
  std::vector<BlockPlanes> planes;  ///< per block
  std::vector<Sheet> sheets;
  std::vector<int> unknown;   ///< as BlockComplex::unknown
  std::vector<int> block_of;  ///< per fine block
};

/// `touched`: (fine block, side, feature) where a feature's node stands on the side. `chart_of_plane`: per axis and plane the chart that a
/// sheet without chart is given instead of being dropped; empty: drop. Throws StageFailed when blocks do not merge to boxes.
Coarse coarsen(const std::vector<Block>& fine, const std::vector<BlockPlanes>& planes, const std::vector<std::array<int, 3>>& touched,
               const std::vector<Chart>& charts, const std::array<std::vector<int>, 3>& chart_of_plane);

}  // namespace polycube
