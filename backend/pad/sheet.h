// The one primitive of padding: a layer of hexahedra inserted along a surface.
#pragma once

#include "pad/pad.h"

namespace polycube {

/// What a sheet goes along: the faces between `inside` hexes and the others, and the listed boundary quads.
struct SheetCut {
  std::vector<char> inside;   ///< per hex: it moves to the inner side of the new layer
  std::vector<char> surface;  ///< per boundary quad: the layer separates it from its hex, which must be inside
};

/// Nodes where the cut cannot be opened into a layer: it branches there, or more than one CAD edge would have to be doubled.
/// Ascending; empty where the cut is fit for insert_sheet.
std::vector<int> sheet_obstacles(const HexMesh& mesh, const Association& association, const SheetCut& cut);

/// Opens the mesh along the cut and fills it with one layer of hexes. The outer copies of nodes keep their number, position and CAD entity;
/// inner copies are appended, a third of a cell inside, and lie inside, on a patch or on the one CAD edge that goes on from there. New
/// boundary quads belong to the patch of the quad on their inner side. Returns the number of new hexes. Throws StageFailed where
/// sheet_obstacles is not empty. `beside`, if not null, gets the quad on the inner side of each new boundary quad.
int insert_sheet(HexMesh& mesh, Association& association, const SheetCut& cut, std::vector<int>* beside = nullptr);

}  // namespace polycube
