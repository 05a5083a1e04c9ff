// Time of blocks, quantize and hex against tets, charts and blocks. One thread.
#include <benchmark/benchmark.h>

#include <cmath>

#include "hex/hex.h"
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
      if (random() % 3 == 0)
        testing::add_box(places, {2 * i + 1, 2 * j + 1, 0}, {2 * i + 2, 2 * j + 2, 2 + static_cast<int>(random() % 3)});
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

BENCHMARK(Blocks)->Arg(12)->Arg(25)->Arg(50)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK_CAPTURE(Quantize, fine, 2.0)->Arg(12)->Arg(25)->Arg(50)->Arg(80)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK_CAPTURE(Quantize, coarse, 0.3)->Arg(12)->Arg(25)->Arg(50)->Arg(80)->Unit(benchmark::kMillisecond)->Complexity();
BENCHMARK(Hexes)->Arg(12)->Arg(25)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace polycube
