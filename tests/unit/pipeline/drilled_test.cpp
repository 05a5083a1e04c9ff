// Bores and arms that go aslant, and the tips that drills leave.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "blocks/blocks.h"
#include "label/features.h"
#include "pipeline/edge_runs.h"
#include "pipeline/inspect.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

/// The labels on the triangles of the CAD faces of one kind.
std::set<int> labels_on(const CadModel& model, const LabelledPart& part, SurfaceKind kind) {
  std::set<int> labels;
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    if (model.face(part.tets.triangle_face[t]).kind == kind) labels.insert(part.labelling.label[t]);
  }
  return labels;
}

// The wall of the wedge faces -X and a little -Z: with one label it would have no border to the side it comes out of.
TEST(ObliqueBore, TheWedgeItLeavesHasTwoLabels) {
  const CadModel model = CadModel::from_brep(shapes::oblique_bore());
  const LabelledPart part = label_part(model, MeshOptions(), Monitor(), Until::kLabels);
  const Inspection found = inspect(part);
  EXPECT_TRUE(found.violations.valid());
  EXPECT_TRUE(found.turning_points.empty());
  const std::set<int> labels = labels_on(model, part, SurfaceKind::kCylinder);
  EXPECT_EQ(labels.count(1), 1u);
  EXPECT_EQ(labels.count(5), 1u);
}

TEST(ObliqueBore, IsMeshedWithAllItsEdges) {
  const CadModel model = CadModel::from_brep(shapes::oblique_bore());
  MeshOptions options;
  options.size = 1.5;
  const MeshResult result = mesh(model, options, Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_GT(result.report.quality.min_scaled_jacobian, 0.2);
}

// The arm comes within 3 degrees of the line at 45 degrees, where the bar's front would end.
TEST(ForkedBar, AThickArmLeavesNoFlaws) {
  const LabelledPart part = label_part(CadModel::from_brep(shapes::forked_bar(6, 4)), MeshOptions(), Monitor());
  const Inspection found = inspect(part);
  EXPECT_TRUE(found.violations.valid());
  EXPECT_TRUE(found.turning_points.empty());
  EXPECT_EQ(part.flipped, 0);
  EXPECT_EQ(edge_table(part).lost, 0);
}

TEST(DrilledBlock, TheTipIsADisc) {
  const CadModel model = CadModel::from_brep(shapes::drilled_block());
  const LabelledPart part = label_part(model, MeshOptions(), Monitor(), Until::kLabels);
  EXPECT_TRUE(inspect(part).violations.valid());
  EXPECT_EQ(labels_on(model, part, SurfaceKind::kCone), std::set<int>{4});
}

// Two edges lead from the tip to the rim, in one line: they need two cells though nothing of the map stands between their ends.
TEST(DrilledBlock, TheTipHasANode) {
  const CadModel model = CadModel::from_brep(shapes::drilled_block());
  MeshOptions options;
  options.size = 3;
  const LabelledPart part = label_part(model, options, Monitor());
  const auto constraints = room_for_edges(edge_chains(model, part.tets), part.tets, part.map, extract_blocks(part.tets, part.map, Monitor()));
  ASSERT_FALSE(constraints.empty());
  for (const DistanceConstraint& c : constraints) {
    EXPECT_EQ(part.map.charts[c.low].axis, part.map.charts[c.high].axis);
    EXPECT_LT(part.map.charts[c.low].value, part.map.charts[c.high].value);
    EXPECT_GE(c.at_least, 2);
  }
  const MeshResult result = mesh(model, options, Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_TRUE(result.association.lost_vertices.empty());
}

TEST(DrilledBlock, EdgesThatEndAtChartsAskNothing) {
  const CadModel model = CadModel::from_brep(shapes::box(10, 20, 30));
  const LabelledPart part = label_part(model, MeshOptions(), Monitor());
  EXPECT_TRUE(room_for_edges(edge_chains(model, part.tets), part.tets, part.map, extract_blocks(part.tets, part.map, Monitor())).empty());
}

// A hexagonal tunnel that breaks a little into the floor of a triangular one: the side of the one is opposite to the floor of the other, unless the floor has a
// narrow strip of another label beside the mouth. Found in a machined block.
TEST(CrossingTunnels, AFloorIsDividedBesideTheMouthThatBreaksIntoIt) {
  const shapes::Prism triangular{2, {{2.63, 6.48}, {3.88, 4.74}, {4.9, 6.38}}, 0, 10};
  const shapes::Prism hexagonal{1, {{7.33, 1.27}, {7.69, 2.2}, {7.06, 2.98}, {6.07, 2.82}, {5.71, 1.88}, {6.34, 1.11}}, 0, 10};
  const CadModel model = CadModel::from_brep(shapes::machined_box(10, {triangular, hexagonal}));
  MeshOptions options;
  options.size = 0.7;
  const MeshResult result = mesh(model, options, Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_EQ(result.report.capture.faces_captured, result.report.capture.faces);
  EXPECT_GT(result.report.quality.min_scaled_jacobian, 0.2);
}

// A slot passes a hexagonal hole and cuts a sixtieth of a cell deeper than one of its sides, which it leaves at 3.5 degrees: its floor has a needle there,
// which the map squeezes to a line. The needle's tip belongs at the node of its image, in the middle of the wall, and not at one beyond on the floor's border.
// Found in a machined block; a tunnel and a chamfer make the labels those of that block.
TEST(CrossingTunnels, ANeedleThatTheMapSqueezesToALineHasItsTip) {
  const shapes::Prism hole{2, {{3.939, 8.998}, {3.105, 8.446}, {3.166, 7.448}, {4.061, 7.002}, {4.895, 7.554}, {4.834, 8.552}}, 0, 10};
  const shapes::Prism slot{1, {{4.288, 2.85}, {7.562, 2.85}, {7.562, 4.85}, {4.288, 4.85}}, 0, 10};
  const shapes::Prism tunnel{0, {{2.933, 7.651}, {4.222, 6.62}, {4.679, 8.239}}, 0, 10};
  const shapes::Prism chamfer{0, {{0, 8.728}, {1.272, 10}, {0, 10}}, 0, 10};
  const CadModel model = CadModel::from_brep(shapes::machined_box(10, {hole, slot, tunnel, chamfer}));
  MeshOptions options;
  options.size = 1;
  options.effort = "quick";
  const MeshResult result = mesh(model, options, Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_EQ(result.report.capture.faces_captured, result.report.capture.faces);
  EXPECT_GT(result.report.quality.min_scaled_jacobian, 0.05);  // sin 3.5 degrees is .061
}

}  // namespace
}  // namespace polycube
