// Connectivity and first geometry of the hexahedral mesh (paper, sections 5.2 and 5.3).
#pragma once

#include "hex/spacing.h"
#include "quantize/quantize.h"

namespace polycube {

struct HexComplex {
  HexMesh mesh;                         ///< points: first geometry, g^-1 of h^-1
  std::vector<Vec3> param;              ///< per node: its place in the image of g
  std::vector<int> hex_block;           ///< per hex: its block; ascending
  std::vector<Quad> quads;              ///< boundary quads, outward
  std::vector<int> quad_chart;          ///< per quad: the chart it lies on
  std::vector<int> quad_triangle;       ///< per quad: a boundary triangle of the tet mesh near its centre (the one g maps nearest to it on that chart)
  std::vector<int> node_feature_first;  ///< CSR over nodes into node_features
  std::vector<int> node_features;       ///< features (chart indices with sign 0) on whose plane sheet the node lies, ascending
};

/// Of a mesh whose integers keep the structure of coarser ones (QuantizeOptions::structure): per hex the cell of the coarser mesh that it is
/// part of, numbered as build_hexes numbers them.
std::vector<int> coarse_cells(const BlockComplex& blocks, const std::vector<int>& coarse, const std::vector<int>& value);

/// Lattice points stand as `spacing` says, evenly by default. Throws StageFailed("hex", ...) when the result is not a valid mesh of the solid (integers that do
/// not satisfy C1 and C2), InvalidInput where it would have more than kMostHexes cells.
HexComplex build_hexes(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, const Quantization& quantization, const Monitor& monitor,
                       const Spacing& spacing = {});

/// What is wrong with the connectivity; all zero or empty on a good mesh.
struct HexReport {
  int hexes = 0;
  int overfull_faces = 0;        ///< faces of more than two cells
  int stray_quads = 0;           ///< boundary faces that are not in `quads` once, or the reverse
  int nonmanifold_edges = 0;     ///< boundary edges without exactly two boundary quads
  int nonmanifold_nodes = 0;     ///< boundary nodes whose quads are not one fan
  int repeated_nodes = 0;        ///< cells with a node twice
  int euler = 0;                 ///< Euler characteristic of the boundary
  int components = 0;            ///< of cells connected through faces
  std::vector<int> lost_charts;  ///< charts (neither features nor collapsed) without a quad
  bool good(int solid_euler) const {
    return hexes > 0 && overfull_faces == 0 && stray_quads == 0 && nonmanifold_edges == 0 && nonmanifold_nodes == 0 && repeated_nodes == 0 && components == 1 &&
           lost_charts.empty() && euler == solid_euler;
  }
};
HexReport check(const HexComplex& hexes, const PolycuboidMap& map, const BlockComplex& blocks);

}  // namespace polycube
