// The block structure that the charts cut out of a polycuboid (paper, sections 3.1 and 5.1).
#pragma once

#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

struct Block {
  std::array<std::array<int, 2>, 3> charts{};  ///< per axis: the charts of its low and its high side (see BlockComplex::unknown)
  std::array<std::array<int, 2>, 3> sheets{};  ///< per axis: the sheets its low and its high side lie on
  std::array<int, 8> corners{};                ///< block vertices, in the order of core/hexahedron.h
  std::array<int, 6> neighbours{};             ///< per side (-u +u -v +v -w +w): the block there, or -1
  std::array<int, 6> side_chart{};             ///< per side: the boundary chart lying on it, or -1 inside
  double volume = 0;                           ///< of its image
  std::vector<int> tets;                       ///< tets that cover it, ascending
};

/// A block's side at the low end of an axis; that at the high end is the next.
constexpr int low_side(int axis) { return 2 * axis; }

/// A connected component of a chart's plane cut through the solid, with the charts it touches.
struct Sheet {
  int axis = 0;
  int unknown = 0;          ///< chart that stands for all charts that must get the same integer as this sheet
  std::vector<int> charts;  ///< charts and features that touch it, ascending
};

struct BlockComplex {
  std::vector<Block> blocks;
  int vertex_count = 0;
  std::vector<std::array<int, 3>> vertex_charts;  ///< per block vertex and axis: the chart (unknown) whose plane it lies on
  std::vector<Sheet> sheets;
  /// Per chart: the chart whose integer it takes. Charts of one axis whose planes are one sheet share it: the smallest of them.
  /// -1 for a feature that no sheet reaches and for a collapsed chart that has no part in another chart's sheet. Block::charts,
  /// vertex_charts and Sheet::unknown hold such representatives only.
  std::vector<int> unknown;
  /// Charts (not features) whose image has no net area, ascending: a label that the map folds away. They bound no block and cut nothing.
  std::vector<int> collapsed;
  /// Per chart: block vertices where one of its nodes stands exactly (ascending). Features only; charts have Block::side_chart.
  std::vector<std::vector<int>> feature_vertices;
};

/// Cuts the solid along the sheets that touch their chart. Works on maps with flipped tets (a block is where the mapping degree is 1)
/// and with images that overlap themselves. Throws StageFailed("blocks", ...) naming the charts when they do not bound a volume,
/// InvalidInput when the arrays do not fit together.
BlockComplex extract_blocks(const TetMesh& tets, const PolycuboidMap& map, const Monitor& monitor);

/// What is wrong with a block complex; all zero or empty on a good one.
struct BlockReport {
  int blocks = 0;
  int boundary_quads = 0;
  int euler = 0;                     ///< Euler characteristic of the boundary
  int nonmanifold_edges = 0;         ///< boundary edges without exactly two boundary sides
  std::vector<int> touching_charts;  ///< charts at those edges, ascending
  int asymmetric_neighbours = 0;     ///< sides whose neighbour does not know them, or has another rectangle
  int bare_sides = 0;                ///< boundary sides that lie on no chart
  std::vector<int> lost_charts;      ///< charts (neither features nor collapsed) on no block side
  bool good(int solid_euler) const {
    return blocks > 0 && nonmanifold_edges == 0 && asymmetric_neighbours == 0 && bare_sides == 0 && lost_charts.empty() && euler == solid_euler;
  }
};
BlockReport check(const BlockComplex& blocks, const PolycuboidMap& map);

/// Euler characteristic of a triangulated surface.
int euler_characteristic(const std::vector<Triangle>& triangles);

}  // namespace polycube
