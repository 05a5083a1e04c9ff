#include "pipeline/structures.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "label/frame.h"
#include "pipeline/pose.h"
#include "support/shapes.h"

namespace polycube {
namespace {

struct Part {
  explicit Part(const std::string& brep, const MeshOptions& given = {})
      : pose(canonical_pose(CadModel::from_brep(brep), given.frame)),
        options(sized(pose.posed(given), pose.model.diagonal() / 20)),
        clock(monitor),
        tets(pose.model, options.size, clock, monitor),
        structures(pose, options, tets, clock, monitor) {}
  static MeshOptions sized(MeshOptions options, double size) {
    options.size = size;
    return options;
  }
  Monitor monitor;
  Pose pose;
  MeshOptions options;
  StageClock clock;
  TetMeshes tets;
  Structures structures;
};

TEST(Structures, AreMadeOnceAndEqualLabelsAreRefused) {
  Part part(shapes::cylinder(5, 12));
  const std::vector<LabelVariant> order = part.structures.label_order();
  EXPECT_EQ(order.front(), LabelVariant());
  const Structure& s = part.structures.structure({.labels = order[0]});
  EXPECT_EQ(s.flipped, 0);
  EXPECT_LT(s.distortion, 0.2);
  EXPECT_GT(s.distortion, 0.01);  // a circle becomes a square
  EXPECT_EQ(&part.structures.structure({.labels = order[0]}), &s);
  for (int again = 0; again < 2; ++again) EXPECT_THROW(part.structures.structure({.labels = order[1]}), StageFailed);
  for (const StageRecord& r : part.clock.records()) EXPECT_GE(r.seconds, 0) << r.name;
  EXPECT_EQ(part.clock.records().front().name, "tet");
}

// The map without features costs as much as that with them, and is there to tell whose folds are the features'.
TEST(RealisedMap, WithoutFoldsItNeedsNoneWithoutFeatures) {
  Part part(shapes::box_with_square(20, 20, 10, 5, 15));
  const Structure& s = part.structures.structure({});
  ASSERT_FALSE(s.features.charts.empty());
  const Labelled& labelled = part.structures.labelled();
  int asked = 0;
  const RealisedMap none;
  const auto bare = [&]() -> const RealisedMap& {
    ++asked;
    return none;
  };
  Features features = s.features;
  DeformOptions options;
  options.merge = merge_distance(part.options.size, part.pose.model.diagonal());
  const RealisedMap realised = realise(part.pose.model, labelled.mesh, labelled.labelling, features, options, part.monitor, bare);
  EXPECT_EQ(asked, 0);
  EXPECT_EQ(realised.map.image, s.map.image);
  features.charts.clear();
  realise(part.pose.model, labelled.mesh, labelled.labelling, features, options, part.monitor, bare);
  EXPECT_EQ(asked, 1);
}

TEST(Structures, OtherFramesAreTriedOnlyWhereTheUserDoesNotSpeakOfAxes) {
  const std::string bevelled = shapes::chamfered_box(10, 4);
  MeshOptions options;
  EXPECT_EQ(Part(bevelled).pose.frames(options).size(), 2u);
  MeshOptions framed;
  framed.frame = {{1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(Part(bevelled, framed).pose.frames(options).size(), 1u);
  MeshOptions labelled;
  labelled.labels = {{1, 0}};
  EXPECT_EQ(Part(bevelled).pose.frames(labelled).size(), 1u);
  MeshOptions sized;
  sized.sizes.push_back({});
  sized.sizes.back().axis = 1;
  EXPECT_EQ(Part(bevelled).pose.frames(sized).size(), 1u);
}

// A quarter of a tube is one block along its bend; the arch of a block is no reason to turn all of it.
TEST(Structures, AFrameAlongABendIsTakenWhereItsMapBendsLess) {
  Part quarter(shapes::tube_sector(20, 10, 10, 90)), arch(shapes::arched_block(40, 25));
  for (Part* part : {&quarter, &arch}) {
    const std::vector<LabelVariant> order = part->structures.label_order();
    const auto turned = std::find_if(order.begin(), order.end(), [](const LabelVariant& v) { return v.frame > 0; });
    ASSERT_NE(turned, order.end());
    EXPECT_EQ(turned - order.begin(), part == &quarter ? 0 : 1);
    EXPECT_EQ(part->structures.label_order(), order);
    // Another tet mesh knows the frame too.
    EXPECT_EQ(part->structures.structure({.labels = *turned, .tet_size = 0.8}).flipped, 0);
  }
  EXPECT_EQ(quarter.structures.structure({.labels = quarter.structures.label_order().front()}).map.charts.size(), 6u);
  MeshOptions framed;
  framed.frame = {{1, 0, 0}, {0, 1, 0}};
  for (const LabelVariant& v : Part(shapes::tube_sector(20, 10, 10, 90), framed).structures.label_order()) EXPECT_EQ(v.frame, 0);
}

// In any frame the map of a part has its charts on planes of the axes.
TEST(Structures, AnotherFrameGivesAMapToo) {
  Part part(shapes::chamfered_box(10, 4));
  const Structure& s = part.structures.structure({.labels = {.frame = 1}});
  EXPECT_EQ(s.flipped, 0);
  for (const Chart& c : s.map.charts) {
    for (int n : c.nodes) EXPECT_EQ(s.map.image[n][c.axis], c.value);
  }
  const Mat3 seen = part.pose.user_axes(part.pose.frames(part.options)[1]);
  EXPECT_NEAR(frame_turn(seen, Mat3::Identity()), 0.785398, 1e-6);
  EXPECT_LT((part.pose.user_axes(part.pose.frame) - part.pose.user_frame).norm(), 1e-12);
}

}  // namespace
}  // namespace polycube
