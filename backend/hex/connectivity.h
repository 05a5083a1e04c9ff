// The hexahedra that the integers make of the blocks.
#pragma once

#include "hex/hex.h"
#include "hex/spacing.h"

namespace polycube {

/// A node's preimage under the quantization: the boxes of the image that it stands for.
struct NodePlace {
  int block;
  Vec3 low, high;  ///< equal where the block has extent along that axis
};

struct Connectivity {
  HexComplex hexes;              ///< all but points, param and quad_triangle
  std::vector<int> place_first;  ///< CSR over nodes into places
  std::vector<NodePlace> places;
  std::vector<int> quad_block;  ///< per quad: the block whose side lies on the chart
};

Connectivity connect(const PolycuboidMap& map, const BlockComplex& blocks, const std::vector<int>& value, const Spacing& spacing);

}  // namespace polycube
