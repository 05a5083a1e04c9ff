// Turning, moving and scaling a part changes nothing in its mesh.
#include "pipeline/pose.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "label/frame.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

struct Part {
  std::string name, brep;
  double size;  // mm, 0: the default
};

std::vector<Part> parts() {
  return {{"box", shapes::box(40, 20, 10), 0},
          {"cylinder", shapes::cylinder(10, 30), 5},
          {"plate", shapes::plate_with_hole(40, 30, 8, 6), 5},
          {"bracket", shapes::l_bracket(40, 10, 30), 5}};
}

struct Change {
  std::string name;
  std::function<std::string(const std::string&)> apply;
  double scale = 1;
};

std::vector<Change> changes() {
  return {{"turned", [](const std::string& b) { return shapes::moved(b, 37, 5, -3, 11); }},
          {"a thousandth", [](const std::string& b) { return shapes::scaled(b, 1e-3); }, 1e-3},
          {"turned, a thousand times", [](const std::string& b) { return shapes::scaled(shapes::moved(b, 151.3, 1, 2, 3), 1e3); }, 1e3}};
}

double node_off(const CadModel& model, const MeshResult& result) {
  double worst = 0;
  for (std::size_t n = 0; n < result.mesh.points.size(); ++n) {
    const CadRef& cad = result.association.point_cad[n];
    const Vec3& p = result.mesh.points[n];
    if (cad.dim == 3) continue;
    double off = std::numeric_limits<double>::infinity();
    if (cad.dim == 0) off = (model.vertex(cad.id) - p).norm();
    if (cad.dim == 1) off = model.project_to_edge(cad.id, p).distance;
    if (cad.dim == 2)
      for (const int f : result.association.patches[cad.id]) off = std::min(off, model.project_to_face(f, p).distance);
    worst = std::max(worst, off);
  }
  return worst;
}

TEST(Pose, TurningMovingAndScalingChangeNoMesh) {
  for (const Part& part : parts()) {
    MeshOptions options;
    options.order = 1;
    options.size = part.size;
    const MeshResult base = mesh(CadModel::from_brep(part.brep), options, Monitor());
    for (const Change& change : changes()) {
      SCOPED_TRACE(part.name + ", " + change.name);
      const CadModel model = CadModel::from_brep(change.apply(part.brep));
      options.size = part.size * change.scale;
      const MeshResult result = mesh(model, options, Monitor());
      EXPECT_EQ(result.mesh.hexes.size(), base.mesh.hexes.size());
      EXPECT_NEAR(result.report.quality.min_scaled_jacobian, base.report.quality.min_scaled_jacobian, 1e-3);
      EXPECT_NEAR(result.report.quality.mean_scaled_jacobian, base.report.quality.mean_scaled_jacobian, 1e-3);
      EXPECT_NEAR(result.report.volume / model.volume(), base.report.volume / base.report.cad_volume, 1e-3);
      EXPECT_NEAR(result.report.size / base.report.size, change.scale, 1e-6 * change.scale);
      EXPECT_LE(node_off(model, result), 1e-11 * (model.diagonal() + model.box_max().norm()));
    }
  }
}

TEST(Pose, LabelsKeepTheirMeaning) {
  const CadModel model = CadModel::from_brep(shapes::moved(shapes::l_bracket(40, 10, 30), 100, 1, 2, 3));
  const Pose pose = canonical_pose(model);
  EXPECT_LT((pose.user_frame - find_frame(model)).norm(), 1e-15);
  for (int label = 0; label < 6; ++label) {
    const Vec3 direction = (label % 2 == 0 ? 1 : -1) * pose.user_frame.row(label / 2).transpose();
    const int posed = pose.posed_label(label);
    const Vec3 there = (posed % 2 == 0 ? 1 : -1) * pose.frame.row(posed / 2).transpose();
    EXPECT_LT((pose.rotation * direction - there).norm(), 1e-9);
    EXPECT_EQ(pose.user_label(posed), label);
  }
  const Vec3 p(7, -4, 9);
  EXPECT_LT((pose.back(pose.scale * (pose.rotation * p) + pose.translation) - p).norm(), 1e-12);
  EXPECT_LT((pose.map_back(pose.scale * (pose.rotation * p) + pose.translation) - pose.user_frame * p).norm(), 1e-12);
}

TEST(Pose, MovedModelsKeepTheirNumbers) {
  for (const Part& part : parts()) {
    SCOPED_TRACE(part.name);
    const CadModel model = CadModel::from_brep(part.brep);
    Mat3 turn;
    turn << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    const Vec3 shift(3, 5, 7);
    const CadModel moved = model.transformed(turn, shift, 2, 1e-9);
    ASSERT_EQ(moved.face_count(), model.face_count());
    for (int f = 1; f <= model.face_count(); ++f) EXPECT_NEAR(moved.face(f).area, 4 * model.face(f).area, 1e-6 * model.face(f).area);
    for (int v = 1; v <= model.vertex_count(); ++v) EXPECT_LT((moved.vertex(v) - (2 * (turn * model.vertex(v)) + shift)).norm(), 1e-8);
    EXPECT_NEAR(moved.volume(), 8 * model.volume(), 1e-6 * model.volume());
  }
}

}  // namespace
}  // namespace polycube
