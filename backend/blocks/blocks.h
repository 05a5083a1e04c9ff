// The block structure that the charts cut out of a polycuboid (paper, sections 3.1 and 5.1).
#pragma once

#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

struct Block {
  std::array<std::array<int, 2>, 3> charts{};      ///< per axis: the charts of its low and its high side
  std::array<int, 8> corners{};                    ///< block vertices, in the order of core/hexahedron.h
  std::array<int, 6> neighbours{};                 ///< per side (-u +u -v +v -w +w): the block there, or -1
  std::array<int, 6> side_chart{};                 ///< per side: the boundary chart lying on it, or -1 inside
  double volume = 0;                               ///< of its image
  std::vector<int> tets;                           ///< tets that cover it
};

struct BlockComplex {
  std::vector<Block> blocks;
  int vertex_count = 0;
  std::vector<std::array<int, 3>> vertex_charts;   ///< per block vertex and axis: the chart whose plane it lies on
};

/// Throws StageFailed("blocks", ...) naming the charts when they do not bound a volume.
BlockComplex extract_blocks(const TetMesh& tets, const PolycuboidMap& map, const Monitor& monitor);

}  // namespace polycube
