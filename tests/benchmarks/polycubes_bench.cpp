// Time of blocks, quantize and hex against tets, charts and blocks. One thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "hex/hex.h"
#include "quantize/dual_flow.h"
#include "quantize/problem.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

/// A plate of n x n places of which a third carry a stud of a height of their own: many charts, and blocks growing as n^2 and more.
testing::Example studs(int n) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::set<testing::Place3> places;
  testing::add_box(places, {0, 0, 0}, {2 * n + 1, 2 * n + 1, 1});
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (random() % 3 == 0) testing::add_box(places, {2 * i + 1, 2 * j + 1, 0}, {2 * i + 2, 2 * j + 2, 2 + static_cast<int>(random() % 3)});
    }
  }
  testing::Example e = testing::tetrahedralise(testing::voxels(places), 1);
  // Walls of one line of studs stay on one plane, as parts have it; heights differ.
  for (Vec3& p : e.map.image) {
    for (int d = 0; d < 3; ++d) p[d] += 0.2 * std::sin(3.0 * p[d] + d);
  }
  for (Chart& c : e.map.charts) c.value = e.map.image[c.nodes.front()][c.axis];
  return e;
}

void counters(benchmark::State& state, const testing::Example& e, const BlockComplex& blocks) {
  state.counters["tets"] = static_cast<double>(e.tets.tets.size());
  state.counters["charts"] = static_cast<double>(e.map.charts.size());
  state.counters["blocks"] = static_cast<double>(blocks.blocks.size());
  state.SetComplexityN(static_cast<benchmark::IterationCount>(blocks.blocks.size()));
}

void Blocks(benchmark::State& state) {
  const testing::Example e = studs(static_cast<int>(state.range(0)));
  BlockComplex blocks;
  for (auto _ : state) blocks = extract_blocks(e.tets, e.map, Monitor());
  counters(state, e, blocks);
}

void Quantize(benchmark::State& state, double scale) {
  const testing::Example e = studs(static_cast<int>(state.range(0)));
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = scale;
  for (auto _ : state) benchmark::DoNotOptimize(quantize(blocks, e.map, options, Monitor()));
  counters(state, e, blocks);
}

void Hexes(benchmark::State& state) {
  const testing::Example e = studs(static_cast<int>(state.range(0)));
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  const Quantization quantization = quantize(blocks, e.map, {}, Monitor());
  for (auto _ : state) benchmark::DoNotOptimize(build_hexes(e.tets, e.map, blocks, quantization, Monitor()));
  counters(state, e, blocks);
}

/// CPU seconds of the median of five runs: one thread, and other work on the machine does not count.
template <class Work>
double median_seconds(const Work& work) {
  std::array<double, 5> seconds;
  for (double& s : seconds) {
    const std::clock_t start = std::clock();
    work();
    s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::sort(seconds.begin(), seconds.end());
  return seconds[2];
}

/// Exponent of the time against the number of blocks, from about 1,000 to about 100,000.
void QuantizeGrowth(benchmark::State& state, double scale) {
  QuantizeOptions options;
  options.scale = scale;
  std::array<double, 2> seconds, count;
  for (auto _ : state) {
    for (int k : {0, 1}) {
      const testing::Example e = studs(k == 0 ? 15 : 152);
      const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
      count[k] = static_cast<double>(blocks.blocks.size());
      seconds[k] = median_seconds([&] { benchmark::DoNotOptimize(quantize(blocks, e.map, options, Monitor())); });
    }
  }
  state.counters["blocks_small"] = count[0];
  state.counters["blocks_large"] = count[1];
  state.counters["ms_small"] = 1e3 * seconds[0];
  state.counters["ms_large"] = 1e3 * seconds[1];
  state.counters["exponent"] = std::log(seconds[1] / seconds[0]) / std::log(count[1] / count[0]);
}

/// A child node of the search: one difference more, from its parent's flow or from nothing.
void Child(benchmark::State& state, bool warm) {
  const testing::Example e = studs(50);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = 0.3;
  const QuantizeProblem problem = build_problem(blocks, e.map, options);
  double weights = 0;
  for (const Term& t : problem.axes[2].terms) weights += t.weight;
  const AxisNetwork network(problem.axes[2], 0x1p50 / weights);
  const AxisFlow parent = *network.solve({});
  std::vector<Difference> decisions;  // a block more of extent
  for (const Term& t : problem.axes[2].terms) decisions.push_back({t.low, t.high, parent.span(t.low, t.high) + 1});
  std::size_t next = 0;
  for (auto _ : state) {
    const Difference& d = decisions[next++ * 97 % decisions.size()];
    if (warm) {
      AxisFlow child = parent;
      benchmark::DoNotOptimize(child.demand(d));
    } else {
      benchmark::DoNotOptimize(network.solve({d}));
    }
  }
  state.counters["unknowns"] = static_cast<double>(problem.axes[2].charts.size());
}

BENCHMARK(Blocks)->Arg(12)->Arg(25)->Arg(50)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK_CAPTURE(Quantize, fine, 2.0)->Arg(12)->Arg(25)->Arg(50)->Arg(80)->Arg(152)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK_CAPTURE(Quantize, coarse, 0.3)->Arg(12)->Arg(25)->Arg(50)->Arg(80)->Arg(152)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK_CAPTURE(QuantizeGrowth, fine, 2.0)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(QuantizeGrowth, coarse, 0.3)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(Child, warm, true)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(Child, cold, false)->Unit(benchmark::kMicrosecond);
BENCHMARK(Hexes)->Arg(12)->Arg(25)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace polycube
