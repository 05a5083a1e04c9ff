// The one primitive of padding: a layer of hexahedra inserted along a surface.
#pragma once

#include "pad/pad.h"
#include "pad/topology.h"

namespace polycube {

/// What a sheet goes along: the faces between `inside` hexes and the others, and the listed boundary quads.
struct SheetCut {
  std::vector<char> inside;   ///< per hex: it moves to the inner side of the new layer
  std::vector<char> surface;  ///< per boundary quad: the layer separates it from its hex, which must be inside
};

/// A mesh opened along a cut and filled with one layer of hexes.
struct OpenedMesh {
  /// Nodes where the cut cannot be opened into a layer: it branches there, or more than one CAD edge would have to be doubled. Ascending; where there are any
  /// the rest is empty.
  std::vector<int> obstacles;
  HexMesh mesh;
  Association association;
  int added = 0;            ///< hexes of the layer
  std::vector<int> beside;  ///< the quad on the inner side of each new boundary quad
};

/// As insert_sheet, of a mesh that stays as it is and whose topology is known.
OpenedMesh open_sheet(const HexMesh& mesh, const Association& association, const SheetCut& cut, const HexTopology& topology);

/// Opens the mesh along the cut and fills it with one layer of hexes. The outer copies of nodes keep their number, position and CAD entity;
/// inner copies are appended, a third of a cell inside, and lie inside, on a patch or on the one CAD edge that goes on from there. New
/// boundary quads belong to the patch of the quad on their inner side. Returns the number of new hexes. Throws StageFailed where there are obstacles.
int insert_sheet(HexMesh& mesh, Association& association, const SheetCut& cut);
int insert_sheet(HexMesh& mesh, Association& association, const SheetCut& cut, const HexTopology& topology);

}  // namespace polycube
