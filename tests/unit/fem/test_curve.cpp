#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "fem/element.h"
#include "fem/fem.h"
#include "unit/fem/fixtures.h"

namespace polycube {
namespace {

FemMesh build(const Example& e, int threads = 1) { return build_fem_mesh(e.model, e.mesh, e.association, {.order = 2, .threads = threads}, Monitor()); }

/// The least ratio of a Jacobian to that with straight edges: corners, Gauss points, middles of edges and faces.
double least_share(const FemMesh& mesh) {
  double least = 1;
  for (const auto& hex : mesh.hexes)
    least = std::min(least, (determinants(curved_places(mesh.points, hex)) / determinants(straight_places(mesh.points, hex))).minCoeff());
  return least;
}

/// The greatest distance of a boundary node from the CAD faces of its quads.
double farthest(const Example& e, const FemMesh& mesh) {
  double most = 0;
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (int p : mesh.quads[q]) most = std::max(most, e.model.project_to_face(mesh.quad_face[q], mesh.points[p]).distance);
  return most;
}

// Four thin cells round a bore: its arcs reach further out than the cells' straight outer edges, which have to give way.
TEST(Curve, InnerEdgesGiveWayToTheCad) {
  for (double outer : {1.9, 1.3, 1.1, 1.03, 1.01}) {
    const Example e = bore_example(outer);
    const FemMesh mesh = build(e);
    EXPECT_TRUE(mesh.straight_nodes.empty()) << outer;
    EXPECT_LT(farthest(e, mesh), 1e-7) << outer;
    EXPECT_GT(least_share(mesh), 0.29) << outer;  // kWanted, 0.3, less rounding
  }
}

TEST(Curve, CornersOnASmoothWallStayOnIt) {
  const Example e = round_cell_example();
  const FemMesh mesh = build(e);
  EXPECT_TRUE(mesh.straight_nodes.empty());
  EXPECT_LT(farthest(e, mesh), 1e-7);
  // The angle of two parabolas through a quarter of the circle each is 168 degrees at their common corner.
  EXPECT_GT(least_share(mesh), 0.1);
}

TEST(Curve, OnlyNodesOnTheCadLeaveTheMiddleInGoodCells) {
  const FemMesh mesh = build(bore_example(1.9));
  int curved = 0;
  for (const auto& hex : mesh.hexes) {
    const HexPlaces is = curved_places(mesh.points, hex), straight = straight_places(mesh.points, hex);
    for (int k = 8; k < 20; ++k) {
      if ((is.col(k) - straight.col(k)).norm() < 1e-12) continue;
      EXPECT_NEAR((is.col(k).head<2>() - Vec2(2, 2)).norm(), 1, 1e-9);
      ++curved;
    }
  }
  EXPECT_EQ(curved, 8);
}

// Quads of one side that stand for the face of the other side: not every middle of theirs can be on it.
TEST(Curve, WhatWouldSpoilACellIsStraightAndNamed) {
  Example e = box_example(2);
  Association& a = e.association;
  const auto stands_at = [&](std::size_t q, double z) { return std::ranges::all_of(a.quads[q], [&](int p) { return e.mesh.points[p][2] == z; }); };
  int bottom = -1;
  for (std::size_t q = 0; q < a.quads.size(); ++q)
    if (stands_at(q, 0)) bottom = a.quad_patch[q];
  for (std::size_t q = 0; q < a.quads.size(); ++q)
    if (stands_at(q, 4)) a.quad_patch[q] = bottom;
  const FemMesh mesh = build(e);
  EXPECT_FALSE(mesh.straight_nodes.empty());
  EXPECT_GT(least_share(mesh), 0);
  MeshReport report;
  complete(report, mesh);
  EXPECT_EQ(report.nodes, 27 + 54);
  EXPECT_EQ(report.straightened_edges, std::ssize(mesh.straight_nodes));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.straightened_faces, std::vector{bottom + 1});
  EXPECT_NE(report.warnings[0].find(name({2, bottom + 1})), std::string::npos) << report.warnings[0];
}

TEST(Curve, DoesNotDependOnThreads) {
  const Example e = bore_example(1.03);
  const FemMesh one = build(e, 1), four = build(e, 4);
  for (std::size_t p = 0; p < one.points.size(); ++p) EXPECT_EQ(one.points[p], four.points[p]);
}

// The Jacobian is linear in the place of each node.
TEST(Determinants, SlopesTellTheChange) {
  const Example e = bore_example(1.3);
  const FemMesh mesh = build(e);
  const HexPlaces places = curved_places(mesh.points, mesh.hexes[1]);
  const Vec3 move(0.03, -0.02, 0.05);
  for (int node = 0; node < 20; ++node) {
    DeterminantSlopes slopes;
    const Determinants before = determinants(places, node, slopes);
    EXPECT_LT((before - determinants(places)).abs().maxCoeff(), 1e-15);
    HexPlaces moved = places;
    moved.col(node) += move;
    const Determinants told = before + (slopes.transpose() * move).array();
    EXPECT_LT((told - determinants(moved)).abs().maxCoeff(), 1e-13) << node;
  }
}

}  // namespace
}  // namespace polycube
