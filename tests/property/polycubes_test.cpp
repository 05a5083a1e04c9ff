// Blocks, quantization and hexes of random polycubes: always a valid mesh, always optimal.
#include <queue>

#include "core/error.h"
#include "quantize/monotone.h"
#include "quantize/problem.h"
#include "support/polycubes_check.h"

namespace polycube {
namespace {

using testing::Cells;
using testing::Example;
using testing::expect_valid;

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
    const bool good =
        *std::min_element(values.begin(), values.end()) == 0 &&
        std::all_of(axis.differences.begin(), axis.differences.end(), [&](const Difference& d) { return values[d.high] - values[d.low] >= d.at_least; });
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
  for (int d = 0; d < 3; ++d) {
    choices[d] = assignments(problem.axes[d], most);
    if (choices[d].empty()) return -1;
  }
  const auto cost = [&](const std::array<std::size_t, 3>& at) { return choices[0][at[0]].first + choices[1][at[1]].first + choices[2][at[2]].first; };
  std::priority_queue<std::pair<double, std::array<std::size_t, 3>>, std::vector<std::pair<double, std::array<std::size_t, 3>>>, std::greater<>> open;
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

/// New places for the planes of the charts: some stay, some are nearly where another one is, by more or less than what counts as one plane.
std::vector<double> random_values(const Example& e, std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> unit(-1, 1);
  constexpr std::array<double, 4> kNearly{1e-13, 1e-10, 1e-8, 1e-6};
  std::vector<double> values;
  for (const Chart& chart : e.map.charts) {
    const double choice = unit(random);
    const double near = kNearly[random() % kNearly.size()];
    values.push_back(chart.value + (choice < -0.3 ? 0 : choice < 0 ? near * unit(random) : spread * unit(random)));
  }
  return values;
}

enum class Kind { kBoxes, kDrilled, kTree, kChain, kSpiral, kSpring };

Cells random_shape(std::mt19937& random, Kind kind, int size) {
  switch (kind) {
    case Kind::kBoxes:
      return testing::random_cells(random, size, 4);
    case Kind::kDrilled:
      return testing::drilled_box(random, size);
    case Kind::kTree:
      return testing::box_tree(random, 2 * size);
    case Kind::kChain:
      return testing::random_chain(random, 1 + size);
    case Kind::kSpiral:
      return testing::flat_spiral(size, 2 + static_cast<int>(random() % 3));
    case Kind::kSpring:
      return testing::spring(1 + size / 3, 2 + static_cast<int>(random() % 2));
  }
  return {};
}

Kind kind_of(unsigned seed) { return static_cast<Kind>(seed % 6); }

bool covers_itself(const Cells& cells) { return std::set<testing::Place3>(cells.places.begin(), cells.places.end()).size() < cells.places.size(); }

/// The blocks, or none and a failure that tells which example it was.
BlockComplex blocks_of(const Example& e, const std::string& what) {
  try {
    return extract_blocks(e.tets, e.map, Monitor());
  } catch (const std::exception& error) {
    ADD_FAILURE() << what << ": " << error.what();
    return {};
  }
}

/// Node coordinates along which no chart holds it, as (node, axis).
std::vector<std::array<int, 2>> free_coordinates(const Example& e, bool boundary) {
  std::vector<std::array<char, 3>> fixed(e.tets.points.size(), {0, 0, 0});
  for (const Chart& chart : e.map.charts) {
    for (int n : chart.nodes) fixed[n][chart.axis] = 1;
  }
  std::vector<std::array<int, 2>> result;
  for (int n = 0; n < static_cast<int>(fixed.size()); ++n) {
    if (boundary && e.inner[n]) continue;
    for (int d = 0; d < 3; ++d) {
      if (!fixed[n][d]) result.push_back({n, d});
    }
  }
  return result;
}

TEST(Polycubes, BoxesTunnelsPocketsTreesAndOverlaps) {
  int charts = 0, overlaps = 0, tunnels = 0, cavities = 0;
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937 random(seed);
    const Cells cells = random_shape(random, kind_of(seed), 2 + static_cast<int>(seed / 6 % 9));
    Example e = testing::tetrahedralise(cells, 1);
    const int euler = euler_characteristic(e.tets.triangles);
    tunnels += euler <= 0;
    cavities += euler > 2;
    overlaps += covers_itself(cells);
    testing::set_values(e, random_values(e, random, 0.35), 20);
    const BlockComplex blocks = blocks_of(e, "seed " + std::to_string(seed));
    charts += static_cast<int>(e.map.charts.size());
    if (blocks.blocks.empty()) continue;
    constexpr std::array<double, 4> kScales{0.0, 0.4, 1.0, 2.7};
    for (double scale : {kScales[seed % 4], kScales[(seed + 1) % 4]}) {
      expect_valid(e, scale, "seed " + std::to_string(seed), blocks);
    }
  }
  EXPECT_GT(charts, 3000 * 10);
  EXPECT_GT(overlaps, 800);
  EXPECT_GT(tunnels, 50);
  EXPECT_GT(cavities, 5);
}

// Any refinement of the coarsest mesh has its block structure: each of its cells a box of the finer ones.
TEST(Polycubes, CoarsestIsSubdivided) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(40000 + seed);
    Example e = testing::tetrahedralise(random_shape(random, kind_of(seed), 2 + static_cast<int>(seed / 6 % 6)), 1);
    testing::set_values(e, random_values(e, random, 0.35), 20);
    const BlockComplex blocks = blocks_of(e, "seed " + std::to_string(seed));
    QuantizeOptions options;
    options.scale = 0;
    const std::vector<int> coarse = quantize(blocks, e.map, options, Monitor()).value;
    const HexComplex cells = expect_valid(e, 0, "coarsest of seed " + std::to_string(seed), blocks);
    options.structure = coarse;
    options.scale = seed % 2 == 0 ? 1.3 : 2.6;
    const HexComplex parts = expect_valid(e, options, "seed " + std::to_string(seed), blocks);
    const std::vector<int> cell = coarse_cells(blocks, coarse, quantize(blocks, e.map, options, Monitor()).value);
    ASSERT_EQ(cell.size(), parts.mesh.hexes.size());
    EXPECT_EQ(std::set<int>(cell.begin(), cell.end()).size(), cells.mesh.hexes.size()) << "seed " << seed;
  }
}

TEST(Polycubes, FlippedAndSquashedTets) {
  int flipped = 0;
  for (unsigned seed = 0; seed < 600; ++seed) {
    std::mt19937 random(10000 + seed);
    Example e = testing::tetrahedralise(random_shape(random, kind_of(seed), 2 + static_cast<int>(seed / 6 % 4)), 2 + static_cast<int>(seed % 2));
    testing::set_values(e, random_values(e, random, 0.3), 20);
    testing::disturb(e, random, 0.05, 0.7);
    flipped += testing::flipped_tets(e);
    const BlockComplex blocks = blocks_of(e, "seed " + std::to_string(seed));
    if (blocks.blocks.empty()) continue;
    expect_valid(e, seed % 2 == 0 ? 0.0 : 1.0, "seed " + std::to_string(seed), blocks);
  }
  EXPECT_GT(flipped, 10000);
}

// Nodes of charts and of their borders overshoot: sheets are torn, charts fold over their borders.
TEST(Polycubes, FoldedBoundaries) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(20000 + seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Example e = testing::tetrahedralise(random_shape(random, kind_of(seed), 2 + static_cast<int>(seed / 6 % 4)), 3);
    testing::set_values(e, random_values(e, random, 0.3), 20);
    int node = -1;
    bool moved = false;
    for (const auto& [n, d] : free_coordinates(e, true)) {
      if (n != node) moved = unit(random) < 0.3;
      node = n;
      if (moved) e.map.image[n][d] += 2 * unit(random) - 1;
    }
    const BlockComplex blocks = blocks_of(e, "seed " + std::to_string(seed));
    if (blocks.blocks.empty()) continue;
    expect_valid(e, seed % 2 == 0 ? 0.0 : 1.0, "seed " + std::to_string(seed), blocks);
  }
}

TEST(Polycubes, OverlapsKeepTheirVolume) {
  for (int corners = 1; corners <= 9; ++corners) {
    const Example e = testing::tetrahedralise(testing::flat_spiral(corners), 1);
    double volume = 0;
    for (const Block& b : extract_blocks(e.tets, e.map, Monitor()).blocks) volume += b.volume;
    EXPECT_NEAR(volume, 3 * (corners + 1) + 1, 1e-9) << corners << " corners";
  }
}

/// Distances that the map's own order allows, between random charts of one axis.
void add_constraints(QuantizeOptions& options, const Example& e, const BlockComplex& blocks, std::mt19937& random) {
  for (int k = 0; k < 2; ++k) {
    int low = static_cast<int>(random() % e.map.charts.size()), high = static_cast<int>(random() % e.map.charts.size());
    if (e.map.charts[low].axis != e.map.charts[high].axis || blocks.unknown[low] < 0 || blocks.unknown[high] < 0) continue;
    if (e.map.charts[low].value > e.map.charts[high].value) std::swap(low, high);
    if (blocks.unknown[low] == blocks.unknown[high]) continue;
    DistanceConstraint c{low, high, static_cast<int>(random() % 3), std::numeric_limits<int>::max(), "constraint " + std::to_string(k)};
    if (random() % 2 == 0) c.at_most = c.at_least + static_cast<int>(random() % 2);
    options.constraints.push_back(c);
  }
}

TEST(Polycubes, OptimumOfSmallOnesIsThatOfBruteForce) {
  int compared = 0, constrained = 0, refused = 0;
  for (unsigned seed = 0; seed < 1200; ++seed) {
    std::mt19937 random(30000 + seed);
    Example e = testing::tetrahedralise(random_shape(random, kind_of(seed), 1 + static_cast<int>(seed / 6 % 3)), 1);
    testing::set_values(e, random_values(e, random, 0.4), 20);
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    QuantizeOptions options;
    options.scale = seed % 3 == 0 ? 0.0 : seed % 3 == 1 ? 0.3 : 0.8;
    options.min_layers = seed % 7 == 0 ? 2 : 1;
    if (seed % 2 == 0) add_constraints(options, e, blocks, random);
    const QuantizeProblem problem = build_problem(blocks, e.map, options);
    if (std::any_of(problem.axes.begin(), problem.axes.end(), [](const AxisProblem& a) { return a.charts.size() > 5; })) continue;
    const double best = brute_force(blocks, e.map, options, 7);
    try {
      const Quantization q = quantize(blocks, e.map, options, Monitor());
      EXPECT_TRUE(check(blocks, e.map, options, q.value).good()) << "seed " << seed;
      EXPECT_NEAR(q.objective, best, 1e-9 * (1 + q.objective)) << "seed " << seed;
      constrained += !options.constraints.empty();
    } catch (const InvalidInput& error) {
      // Only what brute force cannot satisfy either, and never without a constraint that is named.
      EXPECT_LT(best, 0) << "seed " << seed << ": " << error.what();
      EXPECT_NE(std::string(error.what()).find("constraint "), std::string::npos) << error.what();
      ++refused;
    }
    ++compared;
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(constrained, 50);
  EXPECT_GT(refused, 5);
}

}  // namespace
}  // namespace polycube
