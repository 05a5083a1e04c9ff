#include "blocks/blocks.h"

#include <gtest/gtest.h>

#include "blocks/clip.h"
#include "core/error.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

using testing::Example;
using testing::Place3;

double total_volume(const BlockComplex& complex) {
  double sum = 0;
  for (const Block& b : complex.blocks) sum += b.volume;
  return sum;
}

TEST(Blocks, BoxIsOneBlock) {
  const Example e = testing::tetrahedralise(testing::box_cells({2, 3, 1}), 2);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  ASSERT_EQ(complex.blocks.size(), 1u);
  EXPECT_NEAR(complex.blocks[0].volume, 6, 1e-12);
  EXPECT_EQ(complex.blocks[0].tets.size(), e.tets.tets.size());
  EXPECT_EQ(complex.vertex_count, 8);
  for (int side = 0; side < 6; ++side) {
    const Chart& chart = e.map.charts[complex.blocks[0].side_chart[side]];
    EXPECT_EQ(chart.axis, side / 2);
    EXPECT_EQ(chart.sign, side % 2 == 1 ? 1 : -1);
  }
}

TEST(Blocks, LIsThreeBlocks) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {2, 2, 1});
  testing::remove_box(places, {1, 1, 0}, {2, 2, 1});
  const Example e = testing::tetrahedralise(testing::voxels(places), 2);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_EQ(complex.blocks.size(), 3u);
  EXPECT_NEAR(total_volume(complex), 3, 1e-12);
  EXPECT_TRUE(check(complex, e.map).good(2));
}

// Figure 9: the tops of two far towers cut one another's tower nowhere.
TEST(Blocks, SheetsThatDoNotTouchTheirChartCutNothing) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {5, 1, 1});
  testing::add_box(places, {0, 0, 0}, {1, 1, 4});
  testing::add_box(places, {4, 0, 0}, {5, 1, 6});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  // Foot: three blocks between the towers' walls; one block for each tower above it.
  EXPECT_EQ(complex.blocks.size(), 5u);
}

TEST(Blocks, ChartsOnOneSheetShareAnInteger) {
  // A plate with a groove across: both tops are at the same height but on no common sheet; both walls' feet are.
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {3, 1, 2});
  testing::remove_box(places, {1, 0, 1}, {2, 1, 2});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  std::vector<int> tops;
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    if (e.map.charts[c].axis == 2 && e.map.charts[c].value == 2) tops.push_back(complex.unknown[c]);
  }
  ASSERT_EQ(tops.size(), 2u);
  EXPECT_NE(tops[0], tops[1]);
}

TEST(Blocks, StepsOfAZShareTheirSheet) {
  // Two boxes shifted against each other: the upper side of one end and the lower side of the other are one plane and one sheet.
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {1, 3, 1});
  testing::add_box(places, {1, 1, 0}, {2, 4, 1});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  std::vector<int> middle;
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    if (e.map.charts[c].axis == 0 && e.map.charts[c].value == 1) middle.push_back(complex.unknown[c]);
  }
  ASSERT_EQ(middle.size(), 2u);
  EXPECT_EQ(middle[0], middle[1]);
}

TEST(Blocks, OverlappingSpiralKeepsItsBlocksApart) {
  // 16 cells round a ring of 12 places: the last ones stand on the first.
  const Example e = testing::tetrahedralise(testing::flat_spiral(4), 1);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_NEAR(total_volume(complex), 16, 1e-9);
  EXPECT_TRUE(check(complex, e.map).good(2));
}

TEST(Blocks, FlippedTetsVanish) {
  std::mt19937 random(7);
  Example e = testing::tetrahedralise(testing::box_cells({2, 2, 2}), 4);
  testing::disturb(e, random, 0.1, 0.6);
  ASSERT_GT(testing::flipped_tets(e), 50);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_EQ(complex.blocks.size(), 1u);
}

TEST(Blocks, FeatureCutsItsSheetOnly) {
  Example e = testing::tetrahedralise(testing::box_cells({2, 1, 1}), 2);
  const int feature = testing::add_feature(e, 0, 0.5, [](const Vec3& p) { return p[1] == 0 && p[2] == 0; });
  ASSERT_EQ(e.map.charts[feature].nodes.size(), 1u);
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_EQ(complex.blocks.size(), 2u);
  EXPECT_EQ(complex.unknown[feature], feature);
  EXPECT_EQ(complex.feature_vertices[feature].size(), 1u);
  EXPECT_TRUE(check(complex, e.map).good(2));
}

TEST(Blocks, FeatureOnAChartsPlaneTakesItsInteger) {
  Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 2);
  const int feature = testing::add_feature(e, 2, 1.0, [](const Vec3& p) { return p[0] == 0.5; });
  const BlockComplex complex = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_EQ(complex.blocks.size(), 1u);
  EXPECT_EQ(complex.unknown[feature], complex.blocks[0].charts[2][1]);
}

TEST(Blocks, ChartsThatBoundNoVolumeAreNamed) {
  Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  for (Vec3& p : e.map.image) p[2] = -p[2];
  for (Chart& c : e.map.charts) {
    if (c.axis == 2) c.value = -c.value;
  }
  EXPECT_THROW(extract_blocks(e.tets, e.map, Monitor()), StageFailed);
}

TEST(Blocks, MapThatDoesNotFitIsRefused) {
  Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  e.map.charts[0].value += 0.5;
  EXPECT_THROW(extract_blocks(e.tets, e.map, Monitor()), InvalidInput);
  e.map.charts.pop_back();
  EXPECT_THROW(extract_blocks(e.tets, e.map, Monitor()), InvalidInput);
}

TEST(Clip, PartsOfATetSumUpToIt) {
  TetClipper clipper;
  clipper.load({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  EXPECT_NEAR(clipper.volume6(clipper.whole()), 1, 1e-15);
  Polyhedron below, above, low, high;
  clipper.split(clipper.whole(), 0, 0.5, below, above);
  EXPECT_NEAR(clipper.volume6(above), 0.125, 1e-15);
  EXPECT_NEAR(clipper.volume6(below), 0.875, 1e-15);
  clipper.split(below, 1, 0.25, low, high);
  EXPECT_NEAR(clipper.volume6(low) + clipper.volume6(high), 0.875, 1e-15);
}

TEST(Clip, AFaceOnThePlaneLeavesAFlatPieceBelow) {
  TetClipper clipper;
  clipper.load({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
  Polyhedron below, above;
  clipper.split(clipper.whole(), 2, 0.0, below, above);
  ASSERT_FALSE(below.tags.empty());
  EXPECT_EQ(clipper.volume6(below), 0);
  EXPECT_NEAR(clipper.volume6(above), 1, 1e-15);
}

}  // namespace
}  // namespace polycube
