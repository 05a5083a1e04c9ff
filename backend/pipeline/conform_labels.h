// Labels of solids that touch: each solid is labelled by itself, on one tet mesh, and the first of two decides how their interface is cut.
#pragma once

#include "cad/conformal.h"
#include "core/monitor.h"
#include "core/options.h"
#include "label/label.h"

namespace polycube {

struct ConformalLabels {
  TetMesh mesh;                  ///< of all solids, cut along the borders of the labels
  Labelling labelling;           ///< of its triangles, the outer boundary
  std::vector<int> inner_label;  ///< per inner triangle, as the solid with the lower index sees it
  double faults = 0;             ///< Violations::score, summed over the solids, each with all of its boundary, and the outside of all
};

/// What is given: labels of faces per solid, as it sees them, and per joined edge whether it is left out.
struct GivenLabels {
  std::vector<FaceLabels> faces;
  std::vector<char> left_out;
};

/// `attempt`: which of the labellings of every solid is taken, 0 the best by itself. Of `options` the labels of faces do not count.
ConformalLabels label_conformally(const ConformalModel& model, const TetMesh& tets, const LabelOptions& options, const GivenLabels& given, int attempt,
                                  const Monitor& monitor);

/// Charts (sign 0) of the interfaces, connected triangles of one label each: their nodes stand on one plane of the map.
struct InterfaceCharts {
  std::vector<Chart> charts;
  std::vector<int> chart;  ///< per inner triangle: index into charts
};
InterfaceCharts interface_charts(const ConformalLabels& labels);

}  // namespace polycube
