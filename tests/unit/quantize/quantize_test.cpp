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

int chart_at(const Example& e, int axis, int sign, double value) {
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    if (e.map.charts[c].axis == axis && e.map.charts[c].sign == sign && e.map.charts[c].value == value) return static_cast<int>(c);
  }
  return -1;
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

TEST(Quantize, FarTooManyCellsAreRefused) {
  const Example e = testing::tetrahedralise(testing::box_cells({2, 3, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  for (const double scale : {120.0, 1e9, 1e200}) {
    QuantizeOptions options;
    options.scale = scale;
    EXPECT_THROW(quantize(blocks, e.map, options, Monitor()), InvalidInput) << scale;
  }
}

// Every pair is a choice of its own. Without rewards the tree multiplies them: 181 nodes instead of 37.
TEST(Quantize, IndependentChoicesAddUp) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const Example e = testing::row_of_dents(24, seed);
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    for (double scale : {0.0, 0.1, 0.3}) {
      QuantizeOptions options;
      options.scale = scale;
      const Quantization q = quantize(blocks, e.map, options, Monitor());
      EXPECT_TRUE(q.optimal) << scale;
      EXPECT_TRUE(check(blocks, e.map, options, q.value).good());
      EXPECT_LT(q.nodes, 100) << seed << " " << scale;
    }
  }
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

// A bound gives way to a demand, and no other bound with it; clashes with C2 included.
TEST(Quantize, BoundsThatMayYieldDo) {
  const Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  const auto bound = [&](int axis, int at_least) {
    options.constraints.push_back({chart_at(e, axis, -1, 0), chart_at(e, axis, 1, 1), at_least, std::numeric_limits<int>::max(), "a bound", true});
  };
  bound(0, 4);
  bound(1, 5);
  options.constraints.push_back({chart_at(e, 0, -1, 0), chart_at(e, 0, 1, 1), std::numeric_limits<int>::min(), 3, "no more than three"});
  bound(0, 2);
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  EXPECT_EQ(q.yielded, std::vector<int>{0});
  EXPECT_EQ(q.value[chart_at(e, 0, 1, 1)], 2);
  EXPECT_EQ(q.value[chart_at(e, 1, 1, 1)], 5);
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

TEST(Quantize, PastTheNodeLimitTheBestFoundComesWithItsGap) {
  const Example e = testing::row_of_dents(24, 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = 0;
  const double optimum = quantize(blocks, e.map, options, Monitor()).objective;
  for (int limit : {0, 1, 5}) {
    options.node_limit = limit;
    const Quantization q = quantize(blocks, e.map, options, Monitor());
    EXPECT_TRUE(check(blocks, e.map, options, q.value).good());
    EXPECT_LE(q.bound, optimum * (1 + 1e-9));
    EXPECT_GE(q.objective, optimum * (1 - 1e-9));
    EXPECT_EQ(q.optimal, q.gap() < 1e-9);
    EXPECT_FALSE(limit == 0 && q.optimal);
  }
}

// Two dents whose corners must not meet, and an engineer who wants them to.
TEST(Quantize, ClashWithTheShapeIsNamed) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {5, 5, 1});
  testing::remove_box(places, {1, 0, 0}, {2, 2, 1});
  testing::remove_box(places, {3, 3, 0}, {4, 5, 1});
  const Example e = testing::tetrahedralise(testing::voxels(places), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  constexpr int kAny = std::numeric_limits<int>::min();
  QuantizeOptions options;
  options.constraints.push_back({chart_at(e, 0, -1, 2), chart_at(e, 0, 1, 3), kAny, 0, "walls in line"});
  options.constraints.push_back({chart_at(e, 0, -1, 0), chart_at(e, 0, 1, 1), 3, 3, "three cells beside the dent"});
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  EXPECT_TRUE(check(blocks, e.map, options, q.value).good());
  options.constraints.push_back({chart_at(e, 1, -1, 2), chart_at(e, 1, 1, 3), kAny, 0, "floors in line"});
  try {
    quantize(blocks, e.map, options, Monitor());
    FAIL() << "no clash found";
  } catch (const InvalidInput& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("walls in line"), std::string::npos) << text;
    EXPECT_NE(text.find("floors in line"), std::string::npos) << text;
    EXPECT_EQ(text.find("three cells"), std::string::npos) << text;
  }
}

TEST(Quantize, LayersThatClashWithAConstraintAreNamed) {
  const Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.min_layers = 4;
  options.constraints.push_back({chart_at(e, 0, -1, 0), chart_at(e, 0, 1, 1), std::numeric_limits<int>::min(), 3, "no more than three"});
  try {
    quantize(blocks, e.map, options, Monitor());
    FAIL() << "no contradiction found";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("at least 4 elements through every wall"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no more than three"), std::string::npos) << error.what();
  }
}

AxisProblem random_problem(std::mt19937& random, int unknowns, double share) {
  std::uniform_real_distribution<double> unit(0, 1);
  AxisProblem problem;
  for (int i = 0; i < unknowns; ++i) problem.charts.push_back(i);
  for (int i = 0; i < unknowns; ++i) {
    for (int j = i + 1; j < unknowns; ++j) {
      if (j > i + 1 && unit(random) > share) continue;
      problem.terms.push_back({i, j, unit(random), 4 * unit(random) - 0.5});
      problem.differences.push_back({i, j, unit(random) < 0.3 ? 1 : 0});
    }
  }
  return problem;
}

double weight_sum(const AxisProblem& problem) {
  double sum = 0;
  for (const Term& t : problem.terms) sum += t.weight;
  return sum;
}

TEST(DualFlow, MeetsEnumerationOnRandomProblems) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const AxisProblem problem = random_problem(random, 4, 0.7);
    const AxisNetwork network(problem, 0x1p50 / weight_sum(problem));
    const auto solution = network.solve({});
    ASSERT_TRUE(solution);
    double best = std::numeric_limits<double>::infinity();
    for (int code = 0; code < 10 * 10 * 10; ++code) {
      const std::vector<int> values{5, code % 10, code / 10 % 10, code / 100};
      if (std::all_of(problem.differences.begin(), problem.differences.end(),
                      [&](const Difference& d) { return values[d.high] - values[d.low] >= d.at_least; })) {
        best = std::min(best, objective(problem, values));
      }
    }
    // Enumeration moves three of four unknowns within reach of the first.
    const double reached = objective(problem, solution->values());
    EXPECT_LE(reached, best + 1e-9) << "seed " << seed;
    EXPECT_NEAR(solution->bound(), reached, 1e-9) << "seed " << seed;
  }
}

// A repaired flow is as good as one from nothing, whatever was demanded before.
TEST(DualFlow, RepairMeetsSolvingAgain) {
  int contradictions = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const int unknowns = 4 + static_cast<int>(seed % 20);
    const AxisProblem problem = random_problem(random, unknowns, 0.3);
    const AxisNetwork network(problem, 0x1p50 / weight_sum(problem));
    auto flow = network.solve({});
    ASSERT_TRUE(flow);
    std::vector<Difference> extra;
    for (int k = 0; k < 8; ++k) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(unknowns)), b = static_cast<int>(random() % static_cast<unsigned>(unknowns));
      if (a == b) continue;
      extra.push_back({std::min(a, b), std::max(a, b), static_cast<int>(random() % 4)});
      if (random() % 3 == 0) extra.back() = {std::max(a, b), std::min(a, b), -static_cast<int>(random() % 3)};
      const auto again = network.solve(extra);
      const bool holds = flow->demand(extra.back());
      ASSERT_EQ(holds, again.has_value()) << "seed " << seed;
      if (!holds) {
        EXPECT_FALSE(contradiction(problem, extra).empty());
        ++contradictions;
        break;
      }
      for (const Difference& d : extra) EXPECT_TRUE(flow->holds(d));
      for (const Difference& d : problem.differences) EXPECT_TRUE(flow->holds(d));
      EXPECT_NEAR(flow->bound(), again->bound(), 1e-9 * (1 + again->bound())) << "seed " << seed;
      EXPECT_NEAR(objective(problem, flow->values()), flow->bound(), 1e-9 * (1 + flow->bound())) << "seed " << seed;
    }
  }
  EXPECT_GT(contradictions, 5);
}

}  // namespace
}  // namespace polycube
