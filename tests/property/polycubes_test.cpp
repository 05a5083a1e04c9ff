// Blocks, quantization and hexes of random polycubes: always a valid mesh, always optimal.
#include "support/polycubes.h"

#include <gtest/gtest.h>

#include <queue>

#include "core/error.h"
#include "hex/hex.h"
#include "quantize/monotone.h"
#include "quantize/problem.h"

namespace polycube {
namespace {

using testing::Cells;
using testing::Example;

/// C2 by walking from every vertex in every octant.
bool c2_holds(const MonotonePaths& paths, const std::array<const std::vector<int>*, 3>& values) {
  const int n = static_cast<int>(paths.unknowns().size());
  std::vector<std::vector<std::array<int, 3>>> steps(n);  // axis, sign, to
  for (const auto& e : paths.edges()) {
    if ((*values[e.axis])[e.low] != (*values[e.axis])[e.high]) continue;
    steps[e.from].push_back({e.axis, 1, e.to});
    steps[e.to].push_back({e.axis, -1, e.from});
  }
  for (int octant = 0; octant < 8; ++octant) {
    for (int source = 0; source < n; ++source) {
      if (paths.on_chart()[source] == 0) continue;
      std::vector<char> seen(n, 0);
      std::vector<int> reached{source};
      seen[source] = 1;
      for (std::size_t i = 0; i < reached.size(); ++i) {
        for (const auto& [axis, sign, to] : steps[reached[i]]) {
          if ((sign > 0) != ((octant >> axis & 1) != 0) || seen[to]) continue;
          seen[to] = 1;
          reached.push_back(to);
          const int both = paths.on_chart()[source] & paths.on_chart()[to];
          for (int d = 0; d < 3; ++d) {
            if ((both >> d & 1) && paths.unknowns()[source][d] != paths.unknowns()[to][d]) return false;
          }
        }
      }
    }
  }
  return true;
}

/// All assignments of one axis up to `most`, by objective.
std::vector<std::pair<double, std::vector<int>>> assignments(const AxisProblem& axis, int most) {
  std::vector<std::pair<double, std::vector<int>>> found;
  std::vector<int> values(axis.charts.size(), 0);
  for (;;) {
    const bool good = *std::min_element(values.begin(), values.end()) == 0 &&
                      std::all_of(axis.differences.begin(), axis.differences.end(),
                                  [&](const Difference& d) { return values[d.high] - values[d.low] >= d.at_least; });
    if (good) found.push_back({objective(axis, values), values});
    std::size_t i = 0;
    while (i < values.size() && values[i] == most) values[i++] = 0;
    if (i == values.size()) break;
    ++values[i];
  }
  std::sort(found.begin(), found.end());
  return found;
}

double brute_force(const BlockComplex& blocks, const PolycuboidMap& map, const QuantizeOptions& options, int most) {
  const QuantizeProblem problem = build_problem(blocks, map, options);
  const MonotonePaths paths(blocks, map, problem, options.separate_features);
  std::array<std::vector<std::pair<double, std::vector<int>>>, 3> choices;
  for (int d = 0; d < 3; ++d) choices[d] = assignments(problem.axes[d], most);
  const auto cost = [&](const std::array<std::size_t, 3>& at) {
    return choices[0][at[0]].first + choices[1][at[1]].first + choices[2][at[2]].first;
  };
  std::priority_queue<std::pair<double, std::array<std::size_t, 3>>, std::vector<std::pair<double, std::array<std::size_t, 3>>>,
                      std::greater<>>
      open;
  std::set<std::array<std::size_t, 3>> seen;
  open.push({cost({0, 0, 0}), {0, 0, 0}});
  while (!open.empty()) {
    const auto [value, at] = open.top();
    open.pop();
    if (!seen.insert(at).second) continue;
    if (c2_holds(paths, {&choices[0][at[0]].second, &choices[1][at[1]].second, &choices[2][at[2]].second})) return value;
    for (int d = 0; d < 3; ++d) {
      auto next = at;
      if (++next[d] < choices[d].size()) open.push({cost(next), next});
    }
  }
  return -1;
}

void expect_valid(const Example& e, double scale, const std::string& what, const BlockComplex& blocks) {
  QuantizeOptions options;
  options.scale = scale;
  const Quantization q = quantize(blocks, e.map, options, Monitor());
  const QuantizeReport report = check(blocks, e.map, options, q.value);
  EXPECT_TRUE(report.good()) << what << " scale " << scale << ": c1 " << report.c1 << " opposite " << report.opposite << " c2 "
                             << report.c2;
  EXPECT_TRUE(q.optimal) << what;
  EXPECT_NEAR(report.objective, q.objective, 1e-9 * (1 + q.objective)) << what;
  EXPECT_NEAR(q.bound, q.objective, 1e-9 * (1 + q.objective)) << what;
  const HexComplex hexes = build_hexes(e.tets, e.map, blocks, q, Monitor());
  EXPECT_TRUE(check(hexes, e.map, blocks).good(euler_characteristic(e.tets.triangles))) << what << " scale " << scale;
}

std::vector<double> random_values(const Example& e, std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<double> values;
  for (const Chart& chart : e.map.charts) {
    // Some stay on the grid, some are nearly on it.
    const double choice = unit(random);
    values.push_back(chart.value + (choice < -0.3 ? 0 : choice < 0 ? 1e-7 * unit(random) : spread * unit(random)));
  }
  return values;
}

TEST(Polycubes, RandomBoxesTunnelsAndPockets) {
  int charts = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    Example e = testing::tetrahedralise(testing::random_cells(random, 2 + static_cast<int>(seed % 9), 4), 1);
    const std::string what = "seed " + std::to_string(seed);
    testing::set_values(e, random_values(e, random, 0.35));
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    charts += static_cast<int>(e.map.charts.size());
    for (double scale : {0.0, 0.4, 1.0, 2.7}) expect_valid(e, scale, what, blocks);
  }
  EXPECT_GT(charts, 400 * 10);
}

TEST(Polycubes, FlippedAndSquashedTets) {
  int flipped = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(1000 + seed);
    Example e = testing::tetrahedralise(testing::random_cells(random, 3 + static_cast<int>(seed % 5), 3), 3);
    testing::set_values(e, random_values(e, random, 0.3));
    testing::disturb(e, random, 0.02, 0.7);
    flipped += testing::flipped_tets(e);
    const std::string what = "seed " + std::to_string(seed);
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    for (double scale : {0.0, 1.0}) expect_valid(e, scale, what, blocks);
  }
  EXPECT_GT(flipped, 1000);
}

// Nodes of charts and of their borders overshoot: sheets are torn, charts fold over their borders.
TEST(Polycubes, FoldedBoundaries) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(3000 + seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Example e = testing::tetrahedralise(testing::random_cells(random, 3 + static_cast<int>(seed % 5), 3), 3);
    testing::set_values(e, random_values(e, random, 0.3));
    std::vector<std::array<char, 3>> fixed(e.tets.points.size(), {0, 0, 0});
    for (const Chart& chart : e.map.charts) {
      for (int n : chart.nodes) fixed[n][chart.axis] = 1;
    }
    for (std::size_t n = 0; n < fixed.size(); ++n) {
      if (e.inner[n] || unit(random) > 0.3) continue;
      for (int d = 0; d < 3; ++d) {
        if (!fixed[n][d]) e.map.image[n][d] += 2 * unit(random) - 1;
      }
    }
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    for (double scale : {0.0, 1.0}) expect_valid(e, scale, "seed " + std::to_string(seed), blocks);
  }
}

TEST(Polycubes, OverlappingSpirals) {
  for (int corners = 1; corners <= 9; ++corners) {
    std::mt19937 random(static_cast<unsigned>(corners));
    Example e = testing::tetrahedralise(testing::flat_spiral(corners), 1);
    const std::string what = std::to_string(corners) + " corners";
    const BlockComplex straight = extract_blocks(e.tets, e.map, Monitor());
    double volume = 0;
    for (const Block& b : straight.blocks) volume += b.volume;
    EXPECT_NEAR(volume, 3 * (corners + 1) + 1, 1e-9) << what;
    testing::set_values(e, random_values(e, random, 0.3));
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    for (double scale : {0.0, 0.5, 1.0, 3.0}) expect_valid(e, scale, what, blocks);
  }
}

TEST(Polycubes, OptimumOfSmallOnesIsThatOfBruteForce) {
  int compared = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(5000 + seed);
    Example e = testing::tetrahedralise(testing::random_cells(random, 2, 3), 1);
    testing::set_values(e, random_values(e, random, 0.4));
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    QuantizeOptions options;
    options.scale = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 0.3 : 0.9;
    const QuantizeProblem problem = build_problem(blocks, e.map, options);
    if (std::any_of(problem.axes.begin(), problem.axes.end(), [](const AxisProblem& a) { return a.charts.size() > 6; })) continue;
    const Quantization q = quantize(blocks, e.map, options, Monitor());
    EXPECT_NEAR(q.objective, brute_force(blocks, e.map, options, 6), 1e-9 * (1 + q.objective)) << "seed " << seed;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace polycube
