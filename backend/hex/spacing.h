// Where the lattice points of the blocks stand along each axis: closer together where the cells beside are smaller.
#pragma once

#include "blocks/blocks.h"

namespace polycube {

/// Blocks side by side across an axis share their lattice points along it.
struct BlockLayers {
  struct Layer {
    int axis = 0;
    int low = 0, high = 0;    ///< charts, as in Block::charts
    std::vector<int> blocks;  ///< ascending
  };
  std::vector<Layer> layers;
  std::vector<std::array<int, 3>> of;  ///< per block and axis: its layer
};

BlockLayers find_layers(const BlockComplex& blocks);

/// Layers on the low (0) and the high side (1) of one; those without extent are looked through. Ascending.
std::array<std::vector<int>, 2> layers_beside(const BlockComplex& blocks, const BlockLayers& layers, int layer, const std::vector<int>& value);

/// Lengths of `count` cells that are `length` together, from about `first` to about `last` at the ends (neither above the mean), growing from each end by at
/// most `growth` a cell unless too few are there for that.
std::vector<double> graded(int count, double length, double first, double last, double growth);

struct Spacing {
  BlockLayers layers;
  std::vector<std::vector<double>> places;  ///< per layer: of its lattice points, 0 to 1; empty where they are even
};

/// Each layer's cells grow by `growth` from those beside it that are smaller; 1: even ones.
Spacing graded_spacing(const BlockComplex& blocks, const PolycuboidMap& map, const std::vector<int>& value, double growth);

/// In all layers end to end between two charts of an axis: every cell `factor` times as long as the one before it, from one chart to the other.
void bias(const std::vector<int>& value, int from, int to, double factor, Spacing& spacing);

}  // namespace polycube
