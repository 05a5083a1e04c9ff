// Where surfaces touch tangentially, or nearly: labels without flaws, maps without folds, meshes with every edge.
#include <gtest/gtest.h>

#include "pipeline/inspect.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

TEST(Cusps, AnArmTangentToABarrelIsMeshedCompletely) {
  const CadModel model = CadModel::from_brep(shapes::tangent_arm(20, 10));
  const MeshResult result = mesh(model, MeshOptions(), Monitor());
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_TRUE(result.association.lost_vertices.empty());
  EXPECT_EQ(result.association.patches.size(), static_cast<std::size_t>(model.face_count()));
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.3);
}

TEST(Cusps, AnEdgeBetweenChartsThatStandLevelIsCaptured) {
  // The rib's hypotenuse and the plate's end are one chart; the edge between them joins the plate's top on both sides of the rib.
  const LabelledPart part = label_part(CadModel::from_brep(shapes::ribbed_plate(20, 2)), MeshOptions(), Monitor());
  EXPECT_EQ(edge_table(part).lost, 0);
  EXPECT_GT(edge_table(part).feature, 0);
  EXPECT_EQ(part.flipped, 0);
}

}  // namespace
}  // namespace polycube
