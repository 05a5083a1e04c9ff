// Smooth CAD edges that the user does without.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "label/features.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

int plane_face(const CadModel& model) {
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).kind == SurfaceKind::kPlane) return f;
  }
  return 0;
}

class RoundedBox : public testing::Test {
 protected:
  RoundedBox() {
    options_.size = 1.5;
    options_.feature_angle = 5;
  }

  MeshResult run() const { return mesh(model_, options_, Monitor()); }

  CadModel model_ = CadModel::from_brep(shapes::filleted_box(10, 2));
  MeshOptions options_;
};

TEST_F(RoundedBox, IsOnePatchWithoutItsSmoothEdges) {
  const MeshResult result = run();
  EXPECT_EQ(result.association.patches.size(), 1u);
  EXPECT_TRUE(result.association.segments.empty());
  const CadCapture& c = result.report.capture;
  EXPECT_EQ(static_cast<int>(c.ignored_edges.size()), c.edges);
  EXPECT_EQ(static_cast<int>(c.ignored_faces.size()), model_.face_count());
  EXPECT_EQ(static_cast<int>(c.ignored_vertices.size()), model_.vertex_count());
  EXPECT_EQ(c.edges_captured + c.faces_captured + c.vertices_captured, 0);
  EXPECT_TRUE(c.lost_edges.empty() && c.lost_faces.empty() && c.lost_vertices.empty());
  ASSERT_EQ(result.report.warnings.size(), 1u);
  EXPECT_NE(result.report.warnings[0].find(" and 20 more are one surface to the mesh"), std::string::npos) << result.report.warnings[0];
}

TEST_F(RoundedBox, KeepsTheFacesAskedFor) {
  const int kept = plane_face(model_);
  options_.keep_faces = {kept};
  const MeshResult result = run();
  ASSERT_EQ(result.association.patches.size(), 2u);
  EXPECT_EQ(std::count(result.association.patches.begin(), result.association.patches.end(), std::vector{kept}), 1);
  const CadCapture& c = result.report.capture;
  EXPECT_EQ(c.faces_captured, 1);
  EXPECT_EQ(c.edges_captured, static_cast<int>(model_.face(kept).edges.size()));
  EXPECT_EQ(static_cast<int>(c.ignored_faces.size()), model_.face_count() - 1);
  EXPECT_TRUE(c.lost_edges.empty() && c.lost_faces.empty() && c.lost_vertices.empty());
}

TEST(SmoothEdges, AreThoseBelowTheAngleAwayFromFacesToKeep) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 2));
  const auto count = [&](double degrees, const std::vector<int>& kept) {
    const std::vector<char> smooth = smooth_edges(model, degrees * std::numbers::pi / 180, kept);
    return std::count(smooth.begin(), smooth.end(), 1);
  };
  EXPECT_EQ(count(0, {}), 0);
  EXPECT_EQ(count(44, {}), 0);
  // Both rims of the chamfer bend by 45 degrees, all other edges by 90.
  EXPECT_EQ(count(46, {}), 2);
  EXPECT_EQ(count(91, {}), model.edge_count());
  for (int e = 1; e <= model.edge_count(); ++e) {
    if (bend(model.edge(e)) < 1) {
      EXPECT_EQ(count(46, {model.edge(e).faces[0], model.edge(e).faces[1]}), 0);
    }
  }
}

}  // namespace
}  // namespace polycube
