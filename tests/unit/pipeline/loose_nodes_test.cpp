#include "pipeline/loose_nodes.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace polycube {
namespace {

// A node in the middle of CAD edge 1, one on a face and one inside, all moved by `off` mm along the diagonal of the box.
int loose(const CadModel& model, double off) {
  Association association;
  association.patches = {{1}};
  association.point_cad = {{1, 1}, {2, 0}, {3, 1}};
  const auto [from, to] = model.edge_range(1);
  const Vec3 away = off * (model.edge_point(1, (from + to) / 2) - Vec3(5, 5, 5)).normalized();
  return count_loose_nodes(model, association, {model.edge_point(1, (from + to) / 2) + away, model.face_point(1, Vec2(1, 1)) + away, Vec3(5, 5, 5)});
}

TEST(LooseNodes, CountsNodesOfLooseEdgesThatAreOffTheirFaces) {
  const CadModel model = CadModel::from_brep(shapes::loosened(shapes::box(10, 10, 10), 1e-3));
  EXPECT_EQ(loose(model, 1e-5), 1);
  EXPECT_EQ(loose(model, 0), 0);
}

// A precise edge has its nodes on its faces; what is off there is not the file's doing.
TEST(LooseNodes, PassesOverPreciseEdges) { EXPECT_EQ(loose(CadModel::from_brep(shapes::box(10, 10, 10)), 1e-5), 0); }

}  // namespace
}  // namespace polycube
