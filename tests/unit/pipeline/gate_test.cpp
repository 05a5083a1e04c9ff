#include "pipeline/gate.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/quality.h"
#include "support/grids.h"

namespace polycube {
namespace {

using polycube::testing::box_grid;
using polycube::testing::Grid;

// A corner that is all but flat is as bad as one turned over: rounding turns it.
TEST(Gate, RefusesCellsThatAreAllButFlat) {
  const Grid grid = box_grid(2);
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh padded{grid.mesh, grid.association};
  EXPECT_NO_THROW(gate(model, padded, 1, Monitor{}));

  const auto on_diagonal = [](double x) { return Vec3(x, x, x); };
  for (Vec3& p : padded.mesh.points) {
    if ((p - on_diagonal(0.5)).norm() < 1e-9) p = on_diagonal(1.0 / 3 + 1e-7);  // next to the plane of the three nodes beside it in the first cell
  }
  const double least = summarise(padded.mesh).min_scaled_jacobian;
  EXPECT_GT(least, 0);
  EXPECT_LT(least, 1e-5);
  EXPECT_THROW(gate(model, padded, 1, Monitor{}), StageFailed);
}

}  // namespace
}  // namespace polycube
