// Element sizes by CAD entity.
#pragma once

#include <vector>

#include "cad/cad.h"

namespace polycube {

struct EntitySizes {
  double least = 0;           ///< mm: nothing is made smaller on purpose
  std::vector<double> edges;  ///< mm, in the order of CadModel::brep_order(1), which Gmsh's tags follow
  std::vector<double> faces;  ///< mm, likewise
};

/// `size`, or finer where a full circle of the entity's curvature would get fewer than `per_circle` elements (0: never), not below size / 6.
/// Gmsh's own curvature sizing does the same but hangs or crashes on real parts.
EntitySizes entity_sizes(const CadModel& model, double size, double per_circle);

}  // namespace polycube
