#include <gtest/gtest.h>

#include <numbers>
#include <tuple>

#include "core/hexahedron.h"
#include "pad/angles.h"
#include "pad/pad.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

double worst_sector(const CadModel& model, const HexMesh& mesh, const Association& a) {
  double worst = 0;
  for (const Sector& s : find_sectors(model, mesh, a, std::vector<char>(mesh.points.size(), 1))) worst = std::max(worst, angle_cost(s.quads, s.angle));
  return worst;
}

TEST(PadRings, GivesEveryNodeOfAnImprintedCircleTwoQuadsASide) {
  const Grid grid = imprint_grid();
  const CadModel model = CadModel::from_brep(grid.brep);
  ASSERT_EQ(check(grid.mesh, grid.association), std::vector<std::string>{});
  ASSERT_GE(worst_sector(model, grid.mesh, grid.association), 1000);
  PadReport report;
  const PaddedMesh result = pad(model, grid.mesh, grid.association, Monitor{}, &report);
  EXPECT_EQ(check(result.mesh, result.association), std::vector<std::string>{});
  EXPECT_EQ(report.surface_quads, 0);
  EXPECT_EQ(report.rings, 2);
  EXPECT_LT(worst_sector(model, result.mesh, result.association), 0.5);
  EXPECT_EQ(report.added_hexes, static_cast<int>(result.mesh.hexes.size() - grid.mesh.hexes.size()));
}

TEST(PadRings, SectorsOfABoxAreRightAngles) {
  const Grid grid = box_grid(2);
  const CadModel model = CadModel::from_brep(grid.brep);
  int corners = 0;
  for (const Sector& s : find_sectors(model, grid.mesh, grid.association, std::vector<char>(grid.mesh.points.size(), 1))) {
    const int dim = grid.association.point_cad[s.node].dim;
    EXPECT_EQ(s.quads, dim == 0 ? 1 : dim == 1 ? 2 : 4);
    EXPECT_NEAR(s.angle, s.quads * std::numbers::pi / 2, 1e-9);
    corners += dim == 0;
  }
  EXPECT_EQ(corners, 24);
}

TEST(PadRings, AReentrantCornerHasThreeQuarters) {
  const Grid grid = l_grid(2);
  const CadModel model = CadModel::from_brep(grid.brep);
  int reentrant = 0;
  for (const Sector& s : find_sectors(model, grid.mesh, grid.association, std::vector<char>(grid.mesh.points.size(), 1))) {
    if (s.quads != 3) continue;
    EXPECT_NEAR(s.angle, 1.5 * std::numbers::pi, 1e-9);
    ++reentrant;
  }
  EXPECT_EQ(reentrant, 2);
}

TEST(PadRings, AnInnerFaceBetweenTwoPiecesOfOneCadEdgeIsFlatInBothItsCells) {
  Grid grid = box_grid(2);
  const CadModel model = CadModel::from_brep(grid.brep);
  const std::vector<char> all(grid.mesh.points.size(), 1);
  const HexTopology topology = build_topology(grid.mesh, grid.association.quads);
  const auto cost = [&] { return inner_corner_cost(model, grid.mesh, grid.association, topology, all); };
  EXPECT_EQ(cost(), 0);
  // A corner of a hex at the middle of a face, its two edges on the face and the one that leads inside.
  int hex = -1, corner = -1;
  for (int h = 0; h < static_cast<int>(grid.mesh.hexes.size()); ++h) {
    for (int c = 0; c < 8; ++c) {
      const Hex& nodes = grid.mesh.hexes[h];
      const auto& next = kCornerNeighbours[c];
      if (grid.association.point_cad[nodes[c]].dim == 2 && grid.association.point_cad[nodes[next[2]]].dim == 3) std::tie(hex, corner) = std::pair(h, c);
    }
  }
  ASSERT_GE(hex, 0);
  const Hex& nodes = grid.mesh.hexes[hex];
  const int node = nodes[corner];
  const auto lay_edge = [&](int from, int to) {
    grid.association.point_cad[node] = {1, 1};
    // Where the CAD edge goes on straight.
    grid.mesh.points[node] = (model.vertex(model.edge(1).vertices[0]) + model.vertex(model.edge(1).vertices[1])) / 2;
    for (const auto& [k, vertex] : {std::pair(from, 0), std::pair(to, 1)})
      grid.mesh.points[nodes[kCornerNeighbours[corner][k]]] = model.vertex(model.edge(1).vertices[vertex]);
    grid.association.segments = {{nodes[kCornerNeighbours[corner][from]], node}, {node, nodes[kCornerNeighbours[corner][to]]}};
    grid.association.segment_edge = {1, 1};
  };
  lay_edge(0, 1);
  EXPECT_EQ(cost(), 0);  // the sector tells of it
  lay_edge(0, 2);
  EXPECT_GE(cost(), 2 * 1000);  // two cells
}

TEST(PadRings, ASecondCellInACuspIsWorseThanAFlatCorner) {
  EXPECT_GT(angle_cost(2, 0.2) - angle_cost(1, 0.2), angle_cost(1, std::numbers::pi));
  EXPECT_GT(angle_cost(2, 0.5) - angle_cost(1, 0.5), angle_cost(1, std::numbers::pi));
  EXPECT_LT(angle_cost(2, 0.6), angle_cost(1, std::numbers::pi));
}

}  // namespace
}  // namespace polycube
