#include "label/frame.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "label/label.h"
#include "label/validity.h"
#include "support/shapes.h"
#include "tet/tet.h"

namespace polycube {
namespace {

TEST(Frame, TurnCountsAxesOfAnyOrderAndDirection) {
  Mat3 swapped;
  swapped << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  EXPECT_LT(frame_turn(swapped, Mat3::Identity()), 1e-7);
  for (const auto& [turn, expected] : {std::pair(0.3, 0.3), std::pair(std::numbers::pi / 3, std::numbers::pi / 6)}) {
    const Mat3 turned = swapped * Eigen::AngleAxisd(turn, Vec3::UnitX()).toRotationMatrix();
    EXPECT_NEAR(frame_turn(turned, Mat3::Identity()), expected, 1e-7);
  }
}

TEST(Frame, ABoxHasOneWhateverItsPose) {
  const CadModel model = CadModel::from_brep(shapes::moved(shapes::box(3, 4, 5), 37, 1, 2, 3));
  const std::vector<Mat3> frames = find_frames(model, 5);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0], find_frame(model));
  const Mat3 turn = Eigen::AngleAxisd(37 * std::numbers::pi / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LT(frame_turn(frames[0] * turn, Mat3::Identity()), 1e-6);
}

TEST(Frame, ABevelOffersAnother) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 4));
  const std::vector<Mat3> frames = find_frames(model, 5);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_LT(frame_turn(frames[0], Mat3::Identity()), 1e-9);
  EXPECT_NEAR(frame_turn(frames[1], Mat3::Identity()), std::numbers::pi / 4, 1e-9);
  for (const Mat3& f : frames) {
    EXPECT_LT((f * f.transpose() - Mat3::Identity()).norm(), 1e-12);
    EXPECT_GT(f.determinant(), 0);
  }
  EXPECT_EQ(find_frames(model, 1).size(), 1u);
}

// The labels of a quarter of a tube change half way along its bore and outside; in a frame along the bend they need not.
TEST(Frame, OneAlongABendThatLabelsDivide) {
  const auto bisecting = [](const std::string& brep) {
    const CadModel model = CadModel::from_brep(brep);
    TetOptions size;
    size.size = model.diagonal() / 15;
    TetMesh mesh = tetrahedralise(model, size, Monitor());
    const Labelling labelling = label(model, mesh, LabelOptions(), Monitor());
    return bisecting_frame(mesh, labelling, smooth_corners(mesh, labelling.frame, labelling.label));
  };
  const BisectingFrame quarter = bisecting(shapes::tube_sector(20, 10, 10, 90));
  EXPECT_EQ(quarter.of, 4);
  ASSERT_TRUE(quarter.frame);
  EXPECT_NEAR(frame_turn(*quarter.frame, Mat3::Identity()), std::numbers::pi / 4, 1e-3);  // the normals of triangles
  EXPECT_NEAR(std::abs((*quarter.frame * Vec3::UnitZ()).cwiseAbs().maxCoeff()), 1, 1e-9);
  for (const std::string& whole : {shapes::box(1, 2, 3), shapes::tube(20, 10, 10)}) EXPECT_FALSE(bisecting(whole).frame);
}

TEST(Label, AChamferTakesTheAxisItIsAskedTo) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 3));
  TetOptions size;
  size.size = model.diagonal() / 12;
  const TetMesh mesh = tetrahedralise(model, size, Monitor());
  int chamfer = 0;
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).axis.cwiseAbs().maxCoeff() < 0.8) chamfer = f;
  }
  ASSERT_GT(chamfer, 0);
  const Vec3 normal = model.face(chamfer).axis;
  for (int axis = 0; axis < 2; ++axis) {
    LabelOptions options;
    options.chamfer_axis = axis;
    TetMesh cut = mesh;
    LabelReport report;
    const Labelling labelling = label(model, cut, options, Monitor(), &report);
    EXPECT_TRUE(report.valid());
    EXPECT_EQ(report.charts, 6);
    for (std::size_t t = 0; t < cut.triangles.size(); ++t) {
      if (cut.triangle_face[t] != chamfer) continue;
      EXPECT_EQ(labelling.label[t] / 2, axis);
      EXPECT_GT(std::abs(normal[axis]), 0.5);
    }
  }
}

}  // namespace
}  // namespace polycube
