// Sheets round stretches of a patch's border where the number of quads at a node does not fit the angle of the CAD there.
#pragma once

#include "pad/pad.h"

namespace polycube {

struct RingCount {
  int sheets = 0;
  double gain = 0;     ///< fall of the total angle cost, less prices
  bool flat = false;   ///< single quads are left in straight angles
  bool cusps = false;  ///< there are corners of the CAD with room for one cell only
};

enum class RingWay {
  kPlain,
  kThroughCusps,  ///< sheets that end at a cusp may leave through the face beyond it: the cusp keeps one quad, and that quad no flat node
};

/// Where a CAD edge crosses the grid as a staircase, a corner of the stair has one quad on a straight border: no move of nodes makes that
/// cell good. A sheet along the border, through the hexes under the patch, gives every node there two quads. Inserts such sheets one at a
/// time, each the best of a few shapes by total angle_cost, as long as one gains.
RingCount insert_rings(const CadModel& model, PaddedMesh& padded, RingWay way, const Monitor& monitor);

}  // namespace polycube
