#include "hex/hex.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/quality.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

using testing::Example;
using testing::Place3;

struct Made {
  BlockComplex blocks;
  Quantization quantization;
  HexComplex hexes;
};

Made make(const Example& e, double scale) {
  Made made;
  made.blocks = extract_blocks(e.tets, e.map, Monitor());
  QuantizeOptions options;
  options.scale = scale;
  made.quantization = quantize(made.blocks, e.map, options, Monitor());
  made.hexes = build_hexes(e.tets, e.map, made.blocks, made.quantization, Monitor());
  return made;
}

double volume(const HexComplex& hexes) {
  double sum = 0;
  for (const Hex& h : hexes.mesh.hexes) sum += hex_volume(hexes.mesh.points, h);
  return sum;
}

TEST(Hex, IdentityMapGivesTheGrid) {
  std::set<Place3> places;
  testing::add_box(places, {0, 0, 0}, {3, 3, 1});
  testing::remove_box(places, {1, 1, 0}, {2, 2, 1});
  const Example e = testing::tetrahedralise(testing::voxels(places), 2);
  const Made made = make(e, 2);
  EXPECT_EQ(made.hexes.mesh.hexes.size(), 64u);
  EXPECT_NEAR(volume(made.hexes), 8, 1e-9);
  for (std::size_t n = 0; n < made.hexes.param.size(); ++n) {
    EXPECT_NEAR((made.hexes.mesh.points[n] - made.hexes.param[n]).norm(), 0, 1e-9);
  }
  EXPECT_NEAR(summarise(made.hexes.mesh).min_scaled_jacobian, 1, 1e-9);
  EXPECT_TRUE(check(made.hexes, e.map, made.blocks).good(0));
}

TEST(Hex, FarTooManyCellsAreRefused) {
  const Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  Made made = make(e, 1);
  for (int& v : made.quantization.value) v *= 1'000'000;
  EXPECT_THROW(build_hexes(e.tets, e.map, made.blocks, made.quantization, Monitor()), InvalidInput);
}

TEST(Hex, QuadsLieOnTheirChartNearTheirTriangle) {
  const Example e = testing::tetrahedralise(testing::box_cells({2, 1, 1}), 2);
  const Made made = make(e, 3);
  ASSERT_FALSE(made.hexes.quads.empty());
  for (std::size_t q = 0; q < made.hexes.quads.size(); ++q) {
    const Chart& chart = e.map.charts[made.hexes.quad_chart[q]];
    Vec3 centre = Vec3::Zero();
    for (int n : made.hexes.quads[q]) {
      EXPECT_NEAR(made.hexes.mesh.points[n][chart.axis], chart.value, 1e-9);
      centre += made.hexes.mesh.points[n] / 4;
    }
    const int t = made.hexes.quad_triangle[q];
    EXPECT_TRUE(std::binary_search(chart.triangles.begin(), chart.triangles.end(), t));
    Vec3 near = Vec3::Zero();
    for (int n : e.tets.triangles[t]) near += e.tets.points[n] / 3;
    EXPECT_LT((near - centre).norm(), 0.5);
  }
}

TEST(Hex, CornersAndLinesOfASqueezedMapStayOnTheBoundary) {
  Example e = testing::tetrahedralise(testing::box_cells({3, 3, 3}), 2);
  for (Vec3& p : e.map.image) p = p.cwiseProduct(p) / 3;  // keeps every plane, squeezes towards the origin
  for (Chart& c : e.map.charts) c.value = c.value * c.value / 3;
  const Made made = make(e, 1.3);
  int corners = 0;
  for (const Vec3& p : made.hexes.mesh.points) {
    int on = 0;
    for (int d = 0; d < 3; ++d) on += std::abs(p[d]) < 1e-9 || std::abs(p[d] - 3) < 1e-9;
    corners += on == 3;
  }
  EXPECT_EQ(corners, 8);
}

TEST(Hex, FeatureHasAChainOfNodesOnItsPolyline) {
  Example e = testing::tetrahedralise(testing::box_cells({4, 2, 2}), 2);
  const int feature = testing::add_feature(e, 0, 1.5, [](const Vec3& p) { return p[2] == 2; });
  const Made made = make(e, 1);
  int on_line = 0;
  for (std::size_t n = 0; n < made.hexes.param.size(); ++n) {
    const auto begin = made.hexes.node_features.begin() + made.hexes.node_feature_first[n];
    const auto end = made.hexes.node_features.begin() + made.hexes.node_feature_first[n + 1];
    const bool member = std::find(begin, end, feature) != end;
    EXPECT_EQ(member, std::abs(made.hexes.mesh.points[n][0] - 1.5) < 1e-9);
    on_line += member && std::abs(made.hexes.mesh.points[n][2] - 2) < 1e-9;
  }
  EXPECT_EQ(on_line, 3);
}

TEST(Hex, OverlappingSpiralIsUnfolded) {
  const Example e = testing::tetrahedralise(testing::flat_spiral(4), 1);
  const Made made = make(e, 1);
  EXPECT_EQ(made.hexes.mesh.hexes.size(), 16u);
  EXPECT_TRUE(check(made.hexes, e.map, made.blocks).good(2));
}

TEST(Hex, IntegersWithoutC2AreRefused) {
  const Example e = testing::tetrahedralise(testing::box_cells({1, 1, 1}), 1);
  Made made = make(e, 1);
  std::fill(made.quantization.value.begin(), made.quantization.value.end(), 0);
  EXPECT_THROW(build_hexes(e.tets, e.map, made.blocks, made.quantization, Monitor()), StageFailed);
}

}  // namespace
}  // namespace polycube
