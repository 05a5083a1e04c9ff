// Connectivity and first geometry of the hexahedral mesh (paper, sections 5.2 and 5.3).
#pragma once

#include "quantize/quantize.h"

namespace polycube {

struct HexComplex {
  HexMesh mesh;                      ///< points: first geometry, g^-1 of h^-1
  std::vector<Vec3> param;           ///< per node: its place in the image of g
  std::vector<Quad> quads;           ///< boundary quads, outward
  std::vector<int> quad_chart;       ///< per quad: the chart it lies on
  std::vector<int> quad_triangle;    ///< per quad: a boundary triangle of the tet mesh near its centre (the one g maps nearest to it on that chart)
  std::vector<int> node_feature_first;  ///< CSR over nodes into node_features
  std::vector<int> node_features;    ///< features (chart indices with sign 0) on whose plane sheet the node lies
};

HexComplex build_hexes(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const Quantization& quantization,
                       const Monitor& monitor);

}  // namespace polycube
