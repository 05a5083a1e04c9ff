#include "label/choice.h"

#include <gtest/gtest.h>

#include "support/shapes.h"
#include "tet/tet.h"

namespace polycube {
namespace {

TEST(LabelChoice, OneWithoutFaultsEndsTheSearch) {
  const CadModel model = CadModel::from_brep(shapes::cylinder(5, 10));
  TetOptions size;
  size.size = model.diagonal() / 15;
  const TetMesh mesh = tetrahedralise(model, size, Monitor());
  const Monitor monitor;
  LabelChoice choice(model, mesh, LabelOptions(), {Mat3::Identity()}, std::vector<char>(static_cast<std::size_t>(model.edge_count()) + 1, 0), monitor);
  const std::vector<LabelVariant> order = choice.order();
  ASSERT_EQ(order.size(), 20u);
  EXPECT_EQ(order.front(), LabelVariant());
  LabelVariant twin = order[1];
  EXPECT_NE(twin.widest_bend, LabelVariant().widest_bend);
  twin.widest_bend = LabelVariant().widest_bend;
  EXPECT_EQ(twin, LabelVariant());
  const Labelled& best = choice.labelled(order.front());
  EXPECT_EQ(best.faults, 0);
  EXPECT_EQ(best.report.charts, 6);
  EXPECT_EQ(best.labelling.label.size(), best.mesh.triangles.size());
  EXPECT_EQ(&choice.labelled(order.front()), &best);  // made once
  for (const LabelVariant& v : order) EXPECT_EQ(choice.labelled(v).report.charts, 6);
}

}  // namespace
}  // namespace polycube
