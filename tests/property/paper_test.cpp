// The paper's counterexamples: rounding every chart to the nearest integer breaks each of them, the quantization does not.
#include <cmath>

#include "core/error.h"
#include "pipeline/hex_map.h"
#include "support/polycubes_check.h"

namespace polycube {
namespace {

using testing::Example;
using testing::Place3;

std::vector<int> rounded(const Example& e, double scale) {
  std::vector<int> value;
  for (const Chart& c : e.map.charts) value.push_back(static_cast<int>(std::lround(scale * c.value)));
  return value;
}

/// The charts' values by a table per axis: where the planes 0, 1, 2... go.
void stretch(Example& e, const std::array<std::vector<double>, 3>& to) {
  std::vector<double> values;
  for (const Chart& c : e.map.charts) values.push_back(to[c.axis][static_cast<std::size_t>(c.value)]);
  testing::set_values(e, values);
}

/// What rounding does, and that no mesh comes out of it; then that quantization gives a valid one.
QuantizeReport expect_rounding_fails(const Example& e, double scale) {
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = scale;
  Quantization snapped;
  snapped.value = rounded(e, scale);
  const QuantizeReport report = check(blocks, e.map, options, snapped.value);
  EXPECT_FALSE(report.good());
  EXPECT_THROW(build_hexes(e.tets, e.map, blocks, snapped, Monitor()), StageFailed);
  testing::expect_valid(e, scale, "quantized", blocks);
  return report;
}

TEST(PaperExamples, Figure3Collapse) {
  // All of it rounds to nothing.
  const Example box = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  EXPECT_GT(expect_rounding_fails(box, 0.1).opposite, 0);
  // A part that survives, but whose rib, slot and step are far below the cell size.
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {7, 1, 2});
  testing::add_box(places, {1, 0, 2}, {2, 1, 3});
  testing::remove_box(places, {3, 0, 1}, {4, 1, 2});
  testing::remove_box(places, {6, 0, 1}, {7, 1, 2});
  Example part = testing::tetrahedralise(testing::voxels(places), 2);
  stretch(part, {{{0, 2, 2.1, 4, 4.1, 5, 5.8, 6}, {0, 3}, {0, 1.9, 2, 2.1}}});
  EXPECT_GT(expect_rounding_fails(part, 1).opposite, 0);
}

// Two dents from opposite sides of a plate pass each other; between their corners there is only a thin strip. All charts that bound a line
// of blocks stay apart, so C1 holds and no wall is lost: only C2 sees that two points of the solid come to stand in one place.
TEST(PaperExamples, Figure8FeaturesMeetAcrossAThinStrip) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {5, 5, 1});
  testing::remove_box(places, {1, 0, 0}, {2, 2, 1});
  testing::remove_box(places, {3, 3, 0}, {4, 5, 1});
  Example e = testing::tetrahedralise(testing::voxels(places), 2);
  stretch(e, {{{0, 2, 4, 4.2, 6, 8}, {0, 1, 4, 4.2, 6, 8}, {0, 1}}});
  const QuantizeReport report = expect_rounding_fails(e, 1);
  EXPECT_EQ(report.c1, 0);
  EXPECT_EQ(report.opposite, 0);
  EXPECT_GT(report.c2, 0);
}

// The inside of the cup rounds onto its underside; its charts share no edge, so constraints along the surface do not notice.
TEST(PaperExamples, Figure13CupBottom) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {3, 3, 2});
  testing::remove_box(places, {1, 1, 1}, {2, 2, 2});
  Example e = testing::tetrahedralise(testing::voxels(places), 2);
  stretch(e, {{{0, 1, 2, 3}, {0, 1, 2, 3}, {0, 0.3, 3}}});
  EXPECT_EQ(expect_rounding_fails(e, 1).opposite, 1);
  const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
  EXPECT_EQ(testing::expect_valid(e, 1, "cup", blocks).mesh.hexes.size(), 9u * 4 - 3);
}

// A C that closes over its own beginning and a spring: the image covers places twice or more, which a raster sees once and a method that
// counts crossings by parity not at all where it is even.
TEST(PaperExamples, ImageOverItself) {
  for (const auto& [name, cells] : {std::pair("C", testing::flat_spiral(4)), std::pair("spring", testing::spring(3))}) {
    std::map<Place3, int> layers;
    for (const Place3& p : cells.places) ++layers[p];
    std::size_t odd = 0;
    for (const auto& [place, count] : layers) odd += count % 2 == 1;
    ASSERT_LT(layers.size(), cells.places.size()) << name;
    ASSERT_LT(odd, layers.size()) << name;
    const Example e = testing::tetrahedralise(cells, 2);
    const BlockComplex blocks = extract_blocks(e.tets, e.map, Monitor());
    EXPECT_EQ(testing::expect_valid(e, 1, name, blocks).mesh.hexes.size(), cells.places.size()) << name;
    expect_rounding_fails(e, 0.3);
  }
}

// Scales as in the issue of real maps: from twice as fine as the tets to far coarser than the part, where flips are many and walls thin.
TEST(PaperExamples, EveryScaleIsValidAndProved) {
  std::mt19937 random(11);
  std::set<Place3> cup;
  testing::add_box(cup, {0, 0, 0}, {4, 4, 3});
  testing::remove_box(cup, {1, 1, 1}, {3, 3, 3});
  const std::vector<testing::Cells> shapes{testing::voxels(cup), testing::drilled_box(random, 6), testing::flat_spiral(6), testing::spring(2),
                                           testing::box_tree(random, 14)};
  int flipped = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    PolycuboidInput input;
    {
      Example e = testing::tetrahedralise(shapes[i], 3);
      testing::shift_charts(e, random, 0.3);
      testing::disturb(e, random, 0.05, 0.7);
      flipped += testing::flipped_tets(e);
      input.tets = e.tets;
      input.map = e.map;
    }
    const int euler = euler_characteristic(input.tets.triangles);
    for (double scale : {0.5, 1.0, 2.0, 4.0, 8.0, 100.0}) {
      HexMapOptions options;
      options.quantize.scale = scale;
      const HexMapResult r = hex_map(input, options, Monitor());
      EXPECT_TRUE(r.quantization.optimal) << i << " " << scale;
      EXPECT_LE(r.quantization.gap(), 1e-9) << i << " " << scale;
      EXPECT_TRUE(check(r.hexes, input.map, r.blocks).good(euler)) << i << " " << scale;
    }
  }
  EXPECT_GT(flipped, 300);
}

}  // namespace
}  // namespace polycube
