#include <gtest/gtest.h>

#include "core/error.h"
#include "core/quality.h"
#include "pad/sheet.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

SheetCut empty_cut(const Grid& grid) { return {std::vector<char>(grid.mesh.hexes.size(), 0), std::vector<char>(grid.association.quads.size(), 0)}; }

Vec3 centre(const HexMesh& mesh, const Hex& hex) {
  Vec3 sum = Vec3::Zero();
  for (int node : hex) sum += mesh.points[node] / 8;
  return sum;
}

TEST(InsertSheet, BetweenTwoHalvesAddsOneLayerAndCarriesTheAssociation) {
  Grid grid = box_grid(2);  // 6 x 4 x 2 cells
  SheetCut cut = empty_cut(grid);
  for (std::size_t h = 0; h < grid.mesh.hexes.size(); ++h) cut.inside[h] = centre(grid.mesh, grid.mesh.hexes[h])[0] < 1.5;
  const std::size_t segments = grid.association.segments.size(), quads = grid.association.quads.size();
  EXPECT_EQ(insert_sheet(grid.mesh, grid.association, cut), 8);
  EXPECT_EQ(grid.mesh.hexes.size(), 56u);
  EXPECT_EQ(grid.association.quads.size(), quads + 12);
  EXPECT_EQ(grid.association.segments.size(), segments + 4);  // the four long edges of the box get one segment more
  EXPECT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
  EXPECT_EQ(summarise(grid.mesh).inverted, 0);
}

TEST(InsertSheet, UnderOneFaceKeepsItsQuads) {
  Grid grid = box_grid(2);
  SheetCut cut = empty_cut(grid);
  std::fill(cut.inside.begin(), cut.inside.end(), 1);
  const int patch = grid.association.quad_patch[0];
  int count = 0;
  for (std::size_t q = 0; q < grid.association.quads.size(); ++q) {
    cut.surface[q] = grid.association.quad_patch[q] == patch;
    count += cut.surface[q];
  }
  const auto before = grid.association;
  EXPECT_EQ(insert_sheet(grid.mesh, grid.association, cut), count);
  EXPECT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
  for (std::size_t q = 0; q < before.quads.size(); ++q) {
    if (!cut.surface[q]) continue;
    EXPECT_EQ(grid.association.quads[q], before.quads[q]);
  }
  EXPECT_TRUE(std::equal(before.point_cad.begin(), before.point_cad.end(), grid.association.point_cad.begin()));
}

TEST(InsertSheet, RoundOneInnerHexMakesSixCells) {
  Grid grid = box_grid(3);
  SheetCut cut = empty_cut(grid);
  for (std::size_t h = 0; h < grid.mesh.hexes.size(); ++h) {
    if ((centre(grid.mesh, grid.mesh.hexes[h]) - Vec3(1.5, 0.5, 0.5)).norm() < 1e-9) cut.inside[h] = 1;
  }
  EXPECT_EQ(insert_sheet(grid.mesh, grid.association, cut), 6);
  EXPECT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
}

TEST(InsertSheet, RefusesACutThatBranches) {
  Grid grid = box_grid(2);
  SheetCut cut = empty_cut(grid);
  // All hexes but two that meet in one node only: the node's copy would have to open in two places.
  for (std::size_t h = 0; h < grid.mesh.hexes.size(); ++h) {
    const Vec3 c = centre(grid.mesh, grid.mesh.hexes[h]);
    cut.inside[h] = (c - Vec3(1.25, 0.75, 0.25)).norm() > 1e-9 && (c - Vec3(1.75, 1.25, 0.75)).norm() > 1e-9;
  }
  const auto obstacles = open_sheet(grid.mesh, grid.association, cut, build_topology(grid.mesh, grid.association.quads)).obstacles;
  ASSERT_EQ(obstacles.size(), 1u);
  EXPECT_LT((grid.mesh.points[obstacles[0]] - Vec3(1.5, 1, 0.5)).norm(), 1e-9);
  EXPECT_THROW(insert_sheet(grid.mesh, grid.association, cut), StageFailed);
}

TEST(CheckAssociation, NamesWhatIsWrong) {
  const Grid grid = cylinder_grid(4);
  ASSERT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
  Association a = grid.association;
  a.segments.pop_back();
  a.segment_edge.pop_back();
  EXPECT_FALSE(check(grid.mesh, a).empty());
  a = grid.association;
  std::swap(a.quads[0][1], a.quads[0][3]);
  EXPECT_FALSE(check(grid.mesh, a).empty());
  a = grid.association;
  a.quad_patch[0] = (a.quad_patch[0] + 1) % 3;
  EXPECT_FALSE(check(grid.mesh, a).empty());
  HexMesh torn = grid.mesh;
  torn.hexes.pop_back();
  EXPECT_FALSE(check(torn, grid.association).empty());
}

}  // namespace
}  // namespace polycube
