#include "label/strips.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/charts.h"
#include "label/graph_cut.h"
#include "support/shapes.h"

namespace polycube {
namespace {

// The face of the bar, which stands along Z.
int bar_of(const CadModel& model) {
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).kind == SurfaceKind::kCylinder && std::abs(model.face(f).axis[2]) > 0.99) return f;
  }
  return 0;
}

TEST(Strips, LeaveRoomBesideAThickArm) {
  const CadModel model = CadModel::from_brep(shapes::forked_bar(6, 4));
  const int bar = bar_of(model);
  const auto strips = find_strips(model, Mat3::Identity(), bar, 1);
  ASSERT_EQ(strips.size(), 2u);  // left and right of the arm
  const double widest = std::asin(4.0 / 6);
  for (const Strip& s : strips) {
    EXPECT_EQ(s.face, bar);
    EXPECT_EQ(label_axis(s.label), 0);
    EXPECT_EQ(label_sign(s.label), 1);  // the arm is on the +X side
    const auto turn = [](const Vec3& v) { return std::abs(std::atan2(v[1], v[0])); };
    EXPECT_NEAR(turn(s.generator[0]), M_PI / 4, 0.05);
    EXPECT_GT(turn(s.generator[1]), widest + M_PI / 20);
    EXPECT_LT(turn(s.generator[1]), widest + M_PI / 6);
  }
  EXPECT_LT(strips[0].generator[1][1] * strips[1].generator[1][1], 0);
}

TEST(Strips, NoneBesideAThinArmOrOnABareBar) {
  const CadModel thin = CadModel::from_brep(shapes::forked_bar(6, 2));
  EXPECT_TRUE(find_strips(thin, Mat3::Identity(), bar_of(thin), 1).empty());
  const CadModel bare = CadModel::from_brep(shapes::cylinder(6, 20));
  EXPECT_TRUE(find_strips(bare, Mat3::Identity(), bar_of(bare), 1).empty());
}

TEST(Strips, LeaveRoomInTheGapBesideAClaw) {
  for (const double degrees : {42.0, 45.0, 48.0}) {
    const CadModel model = CadModel::from_brep(shapes::claws(10, degrees));
    int rim = 0;
    for (const int f : model.faces()) {
      if (model.face(f).radius > 9) rim = f;
    }
    const auto strips = find_strips(model, Mat3::Identity(), rim, 1);
    ASSERT_EQ(strips.size(), 4u);
    for (const Strip& s : strips) {
      const Vec3 claw = Eigen::AngleAxisd(-degrees / 2 * M_PI / 180, Vec3::UnitZ()) * s.generator[0];
      int axis = 0;
      claw.cwiseAbs().maxCoeff(&axis);
      EXPECT_EQ(s.label, 2 * axis + (claw[axis] < 0));                                            // the claw's outside
      EXPECT_GT(s.generator[0].cross(s.generator[1])[2], std::sin((degrees - 42) * M_PI / 180));  // in the gap that follows it
    }
  }
  // No border of labels is near the claws' sides.
  const CadModel narrow = CadModel::from_brep(shapes::claws(10, 30));
  for (const int f : narrow.faces()) {
    if (narrow.face(f).radius > 9) {
      EXPECT_TRUE(find_strips(narrow, Mat3::Identity(), f, 1).empty());
    }
  }
}

TEST(Strips, AreAtTheEndsOfAnArcThatBoundsASegment) {
  const auto strips_of_bore = [](double degrees) {
    const CadModel model = CadModel::from_brep(shapes::bored_web(8, degrees));
    return find_strips(model, Mat3::Identity(), bar_of(model), 1);
  };
  const auto strips = strips_of_bore(32);
  ASSERT_EQ(strips.size(), 4u);
  for (const Strip& s : strips) {
    EXPECT_NEAR(std::abs(s.generator[0][0]), std::cos(M_PI / 4), 1e-6);
    EXPECT_NEAR(std::abs(s.generator[1][0]), std::cos(16 * M_PI / 180), 1e-6);
    EXPECT_GT(s.generator[0].dot(s.generator[1]), 0.8);
    EXPECT_EQ(s.label, s.generator[0][1] > 0 ? 2 : 3);
  }
  EXPECT_TRUE(strips_of_bore(15).empty());  // no room for three labels
  EXPECT_TRUE(strips_of_bore(55).empty());  // it has three of its own
}

TEST(Strips, AreGivenToTheirSideUnlessTheyMayNotHaveIt) {
  const CadModel model = CadModel::from_brep(shapes::forked_bar(6, 4));
  const int bar = bar_of(model);
  const auto strips = find_strips(model, Mat3::Identity(), bar, 1);
  ASSERT_EQ(strips.size(), 2u);
  // One region in the first strip, one opposite of it.
  const Vec3 inside = 6 * (strips[0].generator[0] + strips[0].generator[1]).normalized();
  Room room{strips, {}};
  RegionGraph graph;
  for (const Vec3& at : {inside, Vec3(-inside)}) {
    const int n = static_cast<int>(room.mesh.points.size());
    for (int k = 0; k < 3; ++k) room.mesh.points.push_back(at);
    room.mesh.triangles.push_back({n, n + 1, n + 2});
    Region region;
    region.face = bar;
    region.triangles = {n / 3};
    region.data = {7, 8, 5, 6, 9, 9};
    graph.regions.push_back(region);
  }
  std::vector<int> label{2, 3};
  give_strips(model, room.mesh, room, graph, label);
  EXPECT_EQ(label, (std::vector<int>{0, 3}));
  EXPECT_EQ(graph.regions[0].data, (std::array<double, 6>{5, 8, 7, 6, 9, 9}));  // no dearer than what it had
  EXPECT_EQ(graph.regions[1].data, (std::array<double, 6>{7, 8, 5, 6, 9, 9}));

  graph.regions[0].data[0] = kForbidden;
  label = {2, 3};
  give_strips(model, room.mesh, room, graph, label);
  EXPECT_EQ(label, (std::vector<int>{2, 3}));
}

TEST(Strips, LabelsChangeOnTheLineBesideThem) {
  const CadModel model = CadModel::from_brep(shapes::forked_bar(6, 4));
  const int bar = bar_of(model);
  Room room{find_strips(model, Mat3::Identity(), bar, 1), {}};
  ASSERT_EQ(room.strips.size(), 2u);
  const Strip& s = room.strips[0];
  const int side = s.generator[0][1] > 0 ? 2 : 3;
  const Vec3 axis = s.generator[0].cross(s.generator[1]).normalized();
  // Degrees beyond the line: just on both sides of it, and far off.
  for (const double degrees : {1.0, -1.0, 180.0}) {
    const int n = static_cast<int>(room.mesh.points.size());
    for (int k = 0; k < 3; ++k) room.mesh.points.push_back(Eigen::AngleAxisd(degrees * M_PI / 180, axis) * (6 * s.generator[0]));
    room.mesh.triangles.push_back({n, n + 1, n + 2});
    room.mesh.triangle_face.push_back(bar);
  }
  std::vector<int> label{0, side, side};
  settle_lines(model, room.mesh, Mat3::Identity(), room, label);
  EXPECT_EQ(label, (std::vector<int>{side, 0, side}));
  label = {5, 5, 5};  // not for the sake of the line
  settle_lines(model, room.mesh, Mat3::Identity(), room, label);
  EXPECT_EQ(label, (std::vector<int>{5, 5, 5}));
}

}  // namespace
}  // namespace polycube
