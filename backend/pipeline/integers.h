// The integers of a map for a size or a number of cells, with all that stands beside it.
#pragma once

#include <functional>

#include "quantize/quantize.h"

namespace polycube {

struct IntegerOptions {
  double scale = 1;         ///< cells per unit of the map
  double wanted_cells = 0;  ///< number of cells to come near to, by other scales; 0: that of the scale
  double growth = 1.5;      ///< of cells beside each other
  bool growing = true;      ///< neighbour_bounds hold
  bool coarsest = false;
  bool local = false;                                     ///< bores are refined by themselves (neighbour_bounds)
  std::function<QuantizeOptions(double scale)> demanded;  ///< what is asked for by name
  std::vector<DistanceConstraint> room;                   ///< more cells where CAD edges and vertices need them
  std::vector<DistanceConstraint> bounds;                 ///< what the part asks for
};

struct Integers {
  Quantization quantization;
  std::vector<std::string> deciding;  ///< names of the bounds that gave more cells than the scale
};

/// Cells that integers give, without padding.
double cell_count(const BlockComplex& blocks, const std::vector<int>& value);

/// Throws as quantize() and `demanded` do.
Integers find_integers(const BlockComplex& blocks, const PolycuboidMap& map, const IntegerOptions& options, const Monitor& monitor);

}  // namespace polycube
