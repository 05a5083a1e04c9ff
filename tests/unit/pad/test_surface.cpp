#include <gtest/gtest.h>

#include "pad/pad.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

PaddedMesh padded(const Grid& grid, PadReport& report) {
  const CadModel model = CadModel::from_brep(grid.brep);
  EXPECT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
  const PaddedMesh result = pad(model, grid.mesh, grid.association, Monitor{}, &report);
  EXPECT_EQ(check(result.mesh, result.association), std::vector<std::string>{});
  return result;
}

TEST(PadSurface, LeavesABoxAlone) {
  PadReport report;
  padded(box_grid(), report);
  EXPECT_EQ(report.surface_quads, 0);
  EXPECT_EQ(report.added_hexes, 0);
}

TEST(PadSurface, LeavesABoreAlone) {
  PadReport report;
  padded(plate_grid(), report);
  EXPECT_EQ(report.surface_quads, 0);
}

TEST(PadSurface, PadsTheSideOfACylinderOnly) {
  const int n = 6;
  PadReport report;
  const PaddedMesh result = padded(cylinder_grid(n), report);
  EXPECT_EQ(report.surface_quads, 4 * n * n);
  EXPECT_EQ(report.added_hexes, 4 * n * n);
  EXPECT_EQ(result.association.quads.size(), 6u * n * n + 2u * 4 * n);  // a ring in each cap
}

TEST(PadSurface, PadsAllOfABall) {
  const int n = 6;
  PadReport report;
  const PaddedMesh result = padded(ball_grid(n), report);
  EXPECT_EQ(report.surface_quads, 6 * n * n);
  EXPECT_EQ(result.association.quads.size(), 6u * n * n);
}

}  // namespace
}  // namespace polycube
