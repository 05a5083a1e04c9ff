#include "quantize/quantize.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "quantize/dual_flow.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

using testing::Example;
using testing::Place3;

std::vector<int> rounded(const Example& e, double scale) {
  std::vector<int> value;
  for (const Chart& c : e.map.charts) value.push_back(static_cast<int>(std::lround(scale * c.value)));
  return value;
}

int chart_at(const Example& e, int axis, int sign, double value) {
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    if (e.map.charts[c].axis == axis && e.map.charts[c].sign == sign && e.map.charts[c].value == value) return static_cast<int>(c);
  }
  return -1;
}

/// Rounding breaks the example, quantization does not.
void expect_rounding_fails(const Example& e, double scale) {
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = scale;
  EXPECT_FALSE(check(blocks, e.map, options, rounded(e, scale)).good());
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  EXPECT_TRUE(check(blocks, e.map, options, q.value).good());
  EXPECT_TRUE(q.optimal);
  EXPECT_NEAR(q.bound, q.objective, 1e-9 * (1 + q.objective));
}

TEST(Quantize, BoxTakesTheNearestIntegers) {
  const Example e = testing::tetrahedralise(testing::box_cells({2, 3, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = 1.4;
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  EXPECT_EQ(q.value[blocks.blocks[0].charts[0][1]], 3);  // 2.8
  EXPECT_EQ(q.value[blocks.blocks[0].charts[1][1]], 4);  // 4.2
  EXPECT_EQ(q.value[blocks.blocks[0].charts[2][1]], 1);  // 1.4
  // Weights are the areas of the faces: 3 * 0.2 + 2 * 0.2 + 6 * 0.4.
  EXPECT_NEAR(q.objective, 3 * 0.2 + 2 * 0.2 + 6 * 0.4, 1e-9);
}

// Figure 3: everything rounds to nothing.
TEST(Quantize, CoarseBoxDoesNotCollapse) {
  expect_rounding_fails(testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1), 0.1);
}

// Figure 8: two dents from opposite sides that miss each other by a thin strip.
TEST(Quantize, DentsDoNotMeetAcrossAThinStrip) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {10, 10, 1});
  testing::remove_box(places, {3, 0, 0}, {5, 5, 1});
  testing::remove_box(places, {5, 6, 0}, {8, 10, 1});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  expect_rounding_fails(e, 0.3);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = 0.3;
  EXPECT_GT(check(blocks, e.map, options, rounded(e, 0.3)).c2, 0);
}

// Figure 13: the bottom of a cup.
TEST(Quantize, ThinBottomOfACupStays) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {12, 12, 12});
  testing::remove_box(places, {4, 4, 1}, {8, 8, 12});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  expect_rounding_fails(e, 0.25);
}

TEST(Quantize, SpiralOverItselfIsQuantized) {
  const Example e = testing::tetrahedralise(testing::flat_spiral(5), 1);
  expect_rounding_fails(e, 0.3);
}

TEST(Quantize, LayersThroughAWall) {
  const Example e = testing::tetrahedralise(testing::box_cells({4, 4, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.min_layers = 3;
  EXPECT_EQ(quantize(blocks, e.map, options, Monitor()).value[chart_at(e, 2, 1, 1)], 3);
  options.min_layers = 1;
  options.constraints.push_back({chart_at(e, 2, -1, 0), chart_at(e, 2, 1, 1), 5, 5, "five divisions"});
  EXPECT_EQ(quantize(blocks, e.map, options, Monitor()).value[chart_at(e, 2, 1, 1)], 5);
  options.constraints.push_back({chart_at(e, 0, -1, 0), chart_at(e, 0, 1, 4), std::numeric_limits<int>::min(), 2, "at most two"});
  EXPECT_EQ(quantize(blocks, e.map, options, Monitor()).value[chart_at(e, 0, 1, 4)], 2);
}

TEST(Quantize, ContradictionIsNamed) {
  const Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  const int low = chart_at(e, 0, -1, 0), high = chart_at(e, 0, 1, 1);
  options.constraints.push_back({low, high, 4, std::numeric_limits<int>::max(), "four layers"});
  options.constraints.push_back({low, high, std::numeric_limits<int>::min(), 3, "no more than three"});
  try {
    quantize(blocks, e.map, options, Monitor());
    FAIL() << "no contradiction found";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("four layers"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("no more than three"), std::string::npos);
  }
}

TEST(Quantize, SizePerDirectionAndRegion) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {4, 1, 1});
  testing::add_box(places, {0, 0, 0}, {1, 1, 3});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.axis_scale = {2, 1, 1};
  const auto wide = quantize(blocks, e.map, options, Monitor()).value;
  EXPECT_EQ(wide[chart_at(e, 0, 1, 4)] - wide[chart_at(e, 0, -1, 0)], 8);
  options.axis_scale = {1, 1, 1};
  for (const Block& b : blocks.blocks) options.block_scale.push_back(e.map.charts[b.charts[2][1]].value > 1 ? 2.0 : 1.0);
  const auto tall = quantize(blocks, e.map, options, Monitor()).value;
  EXPECT_EQ(tall[chart_at(e, 2, 1, 3)] - tall[chart_at(e, 2, 1, 1)], 4);
}

TEST(Quantize, CoarsestThenFinerOnTheSameBlocks) {
  const Example e = testing::tetrahedralise(testing::flat_spiral(3), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  int before = 0;
  for (double scale : {0.0, 1.0, 4.0}) {
    options.scale = scale;
    const auto value = quantize(blocks, e.map, options, Monitor()).value;
    int cells = 0;
    for (const Block& b : blocks.blocks) {
      int n = 1;
      for (const auto& [low, high] : b.charts) n *= value[high] - value[low];
      cells += n;
    }
    EXPECT_GT(cells, before);
    before = cells;
  }
}

TEST(DualFlow, MeetsEnumerationOnRandomProblems) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    AxisProblem problem;
    problem.charts = {0, 1, 2, 3};
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        if (unit(random) < 0.3) continue;
        problem.terms.push_back({i, j, unit(random), 4 * unit(random) - 0.5});
        problem.differences.push_back({i, j, unit(random) < 0.3 ? 1 : 0});
      }
    }
    const AxisSolution solution = solve(problem, {});
    ASSERT_TRUE(solution.feasible);
    double best = std::numeric_limits<double>::infinity();
    for (int code = 0; code < 10 * 10 * 10; ++code) {
      const std::vector<int> values{5, code % 10, code / 10 % 10, code / 100};
      if (std::all_of(problem.differences.begin(), problem.differences.end(),
                      [&](const Difference& d) { return values[d.high] - values[d.low] >= d.at_least; })) {
        best = std::min(best, objective(problem, values));
      }
    }
    // Enumeration moves three of four unknowns within reach of the first.
    EXPECT_LE(solution.objective, best + 1e-9) << "seed " << seed;
    EXPECT_NEAR(solution.bound, solution.objective, 1e-9) << "seed " << seed;
  }
}

}  // namespace
}  // namespace polycube
