// The sheets along which the solid is cut.
#pragma once

#include "blocks/blocks.h"
#include "blocks/topology.h"

namespace polycube {

/// A sheet passing through a tet. Sorted by axis, then plane, in SheetCuts::cuts.
struct Cut {
  int axis;
  int plane;  ///< index into SheetCuts::planes[axis]
  int sheet;  ///< index into SheetCuts::sheets
};

struct SheetCuts {
  std::vector<Vec3> image;                    ///< of the map, chart nodes moved onto their plane
  std::array<std::vector<double>, 3> planes;  ///< distinct chart values, ascending
  std::vector<int> chart_plane;               ///< per chart
  bool all = false;                           ///< cut along all of every plane, not only the components that touch a chart
  std::vector<int> sign;                      ///< per chart: which way its image faces; 0 for features
  std::vector<char> collapsed;                ///< per chart: a boundary chart without net area, which cuts nothing
  std::vector<int> chart_sheet;               ///< per chart with a sign: the sheet it lies on; -1 for features
  std::vector<Sheet> sheets;                  ///< unknown -1 and no charts where no chart is touched
  std::vector<int> unknown;                   ///< as BlockComplex::unknown
  std::vector<int> first;                     ///< CSR over tets
  std::vector<Cut> cuts;
  double tolerance = 0;  ///< chart values nearer than this are one plane
};

SheetCuts find_sheets(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, bool all, const Monitor& monitor);

}  // namespace polycube
