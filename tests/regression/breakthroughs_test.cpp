// Where cuts break through each other: narrow tips, corners between two cells, nodes of faces that want to leave them, cells sunk below a face.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

/// The grid that the structure was seen to fail on: of one size, without bounds on counts.
MeshOptions plain_options(const CadModel& model) {
  MeshOptions options;
  options.size = model.diagonal() / 30;
  options.min_layers = 1;
  options.per_circle = 0;
  return options;
}

void expect_complete(const std::string& brep, double least) {
  const CadModel model = CadModel::from_brep(brep);
  const MeshResult result = mesh(model, plain_options(model), Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_EQ(result.association.patches.size(), static_cast<std::size_t>(model.face_count()));
  EXPECT_GE(result.report.quality.min_scaled_jacobian, least);
}

TEST(Breakthroughs, AHoleThroughTheWallOfASlotIsMeshedCompletely) { expect_complete(shapes::hole_through_slot(), 0.2); }

TEST(Breakthroughs, ASlotThroughTheEdgeOfAHoleIsMeshedCompletely) { expect_complete(shapes::slots_through_hole(), 0.3); }

TEST(Breakthroughs, AHolePastTheEdgeOfAChamferIsMeshedCompletely) { expect_complete(shapes::hole_past_chamfer(0.256, 0), 0.15); }

TEST(Breakthroughs, AChamferThatTouchesTheFlatsOfABoltIsMeshedCompletely) {
  const std::string bolt = shapes::hexagon_bolt(18, 20);
  ASSERT_EQ(CadModel::from_brep(bolt).face_count(), 16);  // six flats, six pieces of the cone, both sides of the head, the shank and its end
  expect_complete(bolt, 0.05);
}

// A sheet may leave cells below the boundary that touch it along two edges from one node: that corner is flat wherever the nodes go.
TEST(Breakthroughs, AFivesidedPyramidIsMeshedCompletely) {
  const CadModel pyramid = CadModel::from_brep(shapes::pointed(5, 10, 14));
  const MeshResult result = mesh(pyramid, {}, Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.1);
}

TEST(Breakthroughs, ACornerTwoCellsFromAnEdgeAsksForNoFinerGrid) {
  const CadModel model = CadModel::from_brep(shapes::hole_past_chamfer(0.35, 1));
  const MeshResult result = mesh(model, plain_options(model), Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_EQ(std::count(result.report.warnings.begin(), result.report.warnings.end(), "the cells are finer than asked for"), 0);
}

}  // namespace
}  // namespace polycube
