// The stages blocks, quantize and hex on a given polycuboid map, without CAD (file formats: at read_polycuboid).
#pragma once

#include <string>

#include "hex/hex.h"

namespace polycube {

/// A tet mesh with labels and a map, as read from files. There is no CAD: triangle_face holds 1 + the chart's index.
struct PolycuboidInput {
  TetMesh tets;
  PolycuboidMap map;
};

/// Medit mesh of the solid, Medit mesh of its image (same tets), and one label per tet facet (four lines a tet, facets opposite to the
/// vertices 0 to 3; -1 inside, 0..5 = +X -X +Y -Y +Z -Z). Throws InvalidInput.
PolycuboidInput read_polycuboid(const std::string& tets_path, const std::string& labels_path, const std::string& map_path);

/// Charts of equally labelled triangles with their value: the mean over the nodes, one value for charts of an axis that share nodes.
/// Moves the image of chart nodes exactly onto their plane.
void place_charts(PolycuboidInput& input, const std::vector<int>& triangle_labels);

struct HexMapOptions {
  QuantizeOptions quantize;   ///< scale is in hex edges per unit of the map
  bool scale_by_tets = true;  ///< scale is the hex edge over the mean tet edge in the map instead; 0: coarsest
  bool subdivide = false;     ///< subdivide the cells of the coarsest mesh, instead of the best integers for the scale
};

struct HexMapResult {
  double scale = 0;         ///< eta used
  QuantizeOptions options;  ///< used, with that scale
  BlockComplex blocks;
  Quantization quantization;
  HexComplex hexes;
  int cells = 0;              ///< of the block structure: of the coarsest mesh where that was subdivided, else blocks
  std::vector<int> hex_cell;  ///< per hex: the cell that it is part of
  double blocks_seconds = 0, quantize_seconds = 0, hex_seconds = 0;
};

HexMapResult hex_map(const PolycuboidInput& input, const HexMapOptions& options, const Monitor& monitor);

/// Other integers on the blocks of an earlier result: only quantization and hex run. With the earlier integers as options.quantize.structure
/// its cells are subdivided.
HexMapResult hex_map(const PolycuboidInput& input, const BlockComplex& blocks, const HexMapOptions& options, const Monitor& monitor);

/// Mean length of the tet edges in the image.
double mean_edge(const PolycuboidInput& input);

/// VTK unstructured grid of the hexahedra, with `blocks` (one per hex) and the scaled Jacobian as cell data.
void write_vtu(const std::string& path, const HexComplex& hexes, const std::vector<int>& blocks);

/// Medit file with hexahedra and boundary quads (reference: 1 + chart).
void write_medit(const std::string& path, const HexComplex& hexes);

/// JSON object: blocks, those left with extent by the integers (blocks_left), cells of the block structure, charts, hexes, objective, bound,
/// gap, C2 rounds, nodes, seconds per stage, quality of the first geometry.
std::string report_json(const PolycuboidInput& input, const HexMapResult& result);

/// JSON object with the whole quantization problem (terms, constraints, block edges), for comparison with other solvers.
std::string problem_json(const PolycuboidInput& input, const HexMapResult& result);

}  // namespace polycube
