// Integer positions of the charts (paper, sections 3 to 5).
#pragma once

#include "blocks/blocks.h"

namespace polycube {

struct QuantizeOptions {
  double scale = 1;  ///< eta of section 6.2: target integer distance = scale * distance in the map; near 0 gives the coarsest
};

struct Quantization {
  std::vector<int> value;   ///< per chart (features included)
  double objective = 0;     ///< Eq. 4
  double bound = 0;         ///< proved lower bound
  int c2_rounds = 0;        ///< times a solution was checked against C2
  int nodes = 0;            ///< of the search tree
};

Quantization quantize(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, const Monitor& monitor);

}  // namespace polycube
