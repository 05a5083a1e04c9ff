// Layers under smooth regions of the boundary on which the grid has an edge.
#pragma once

#include "pad/trial.h"

namespace polycube {

/// How the regions that need a layer get it.
enum class LayerPlan {
  kEach,             ///< one after the other
  kTogether,         ///< one layer under all of them and what lies beyond their concave edges
  kBands,            ///< pillows round the edges at fault, a few quads wide, that end inside the region; then as kEach
  kTogetherThrough,  ///< one layer under all of them, going on straight through the solid from their concave edges
};

struct LayerCount {
  int regions = 0;  ///< regions that asked for one when no layer, or the common one, was in place
  int quads = 0;    ///< boundary quads that got a layer
  double gain = 0;  ///< fall of the total angle cost, less prices
};

/// Finds smooth regions (quads joined across edges that a layer cannot end at) whose edges would be cheaper with a layer, and inserts
/// layers. For a single region the best of: under it alone, going on through the solid from its concave edges; under it and all beyond its
/// concave edges; under everything.
LayerCount insert_surface_layers(const CadModel& model, PaddedMesh& padded, LayerPlan plan, const Monitor& monitor);

/// One layer under the quads that `region` flags, going on straight through the solid from their concave edges, where it costs nothing in angles. False, and
/// the mesh as it was, where it does or cannot be opened.
bool insert_layer_under(const CadModel& model, PaddedMesh& padded, const std::vector<char>& region);

/// Carries a surface cut on from its concave edges straight through the solid (at an edge with four hexes through the face opposite) and
/// says which hexes are inside. `region` flags boundary quads. False if the cut does not separate the mesh.
bool extend_cut(const HexMesh& mesh, const HexTopology& topology, const std::vector<BoundaryEdge>& edges, const std::vector<double>& angles,
                const std::vector<char>& region, SheetCut& cut);

}  // namespace polycube
