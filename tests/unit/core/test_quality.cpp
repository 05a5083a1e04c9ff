// Cells whose measures are known from the definitions.
#include <gtest/gtest.h>

#include <cmath>

#include "core/hexahedron.h"
#include "core/quality.h"

namespace polycube {
namespace {

struct Cell {
  std::vector<Vec3> points;
  Hex hex{0, 1, 2, 3, 4, 5, 6, 7};
};

/// The unit cube, each corner moved by `move`.
template <class Move>
Cell cell(const Move& move) {
  Cell c;
  for (const auto& at : kCornerCoordinates) c.points.push_back(move(Vec3(at[0], at[1], at[2])));
  return c;
}

TEST(Quality, OfACube) {
  const Cell cube = cell([](const Vec3& p) { return Vec3(3 * p + Vec3(1, 2, 3)); });
  EXPECT_NEAR(scaled_jacobian(cube.points, cube.hex), 1, 1e-15);
  EXPECT_NEAR(edge_ratio(cube.points, cube.hex), 1, 1e-15);
  EXPECT_NEAR(skew(cube.points, cube.hex), 0, 1e-15);
  EXPECT_NEAR(warpage(cube.points, cube.hex), 0, 1e-15);
}

TEST(Quality, OfABrick) {
  const Cell brick = cell([](const Vec3& p) { return Vec3(2 * p[0], 3 * p[1], 8 * p[2]); });
  EXPECT_DOUBLE_EQ(scaled_jacobian(brick.points, brick.hex), 1);
  EXPECT_DOUBLE_EQ(edge_ratio(brick.points, brick.hex), 4);
  EXPECT_NEAR(skew(brick.points, brick.hex), 0, 1e-15);
  EXPECT_NEAR(warpage(brick.points, brick.hex), 0, 1e-15);
}

// Two axes 60 degrees apart: the cosine is the skew, the sine the scaled Jacobian.
TEST(Quality, OfAShearedCell) {
  const Cell sheared = cell([](const Vec3& p) { return Vec3(p[0] + 0.5 * p[1], std::sqrt(0.75) * p[1], p[2]); });
  EXPECT_NEAR(scaled_jacobian(sheared.points, sheared.hex), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(edge_ratio(sheared.points, sheared.hex), 1, 1e-15);
  EXPECT_NEAR(skew(sheared.points, sheared.hex), 0.5, 1e-15);
  EXPECT_NEAR(warpage(sheared.points, sheared.hex), 0, 1e-15);
}

// The top turned by 90 degrees: two normals at opposite corners of a side are (0,-1,1) and (1,0,-1), their cosine is -1/2.
TEST(Quality, OfATwistedCell) {
  const Cell twisted = cell([](const Vec3& p) { return p[2] > 0 ? Vec3(1 - p[1], p[0], 1) : p; });
  EXPECT_NEAR(warpage(twisted.points, twisted.hex), 1.125, 1e-15);
  EXPECT_NEAR(skew(twisted.points, twisted.hex), 0, 1e-15);
  EXPECT_NEAR(edge_ratio(twisted.points, twisted.hex), std::sqrt(2), 1e-15);
}

// A corner lifted by h: the normals beside it are (0,-h,1) and (-h,0,1), their cosine is 1 / (1 + h^2).
TEST(Quality, WarpageOfALiftedCorner) {
  const double h = 0.5;
  const Cell lifted = cell([&](const Vec3& p) { return p == Vec3(1, 1, 1) ? Vec3(1, 1, 1 + h) : p; });
  EXPECT_NEAR(warpage(lifted.points, lifted.hex), 1 - std::pow(1 / (1 + h * h), 3), 1e-12);
}

TEST(Quality, OfACellWithoutSize) {
  const Cell flat = cell([](const Vec3& p) { return Vec3(p[0], p[1], 0); });
  EXPECT_EQ(scaled_jacobian(flat.points, flat.hex), -1);
  EXPECT_TRUE(std::isinf(edge_ratio(flat.points, flat.hex)));
  EXPECT_EQ(skew(flat.points, flat.hex), 1);
  EXPECT_EQ(warpage(flat.points, flat.hex), 1);
}

TEST(Quality, SummaryHoldsLeastMeanAndMost) {
  HexMesh mesh;
  for (const double length : {1.0, 2.0, 6.0}) {
    const Cell brick = cell([&](const Vec3& p) { return Vec3(length * p[0], p[1], p[2]); });
    Hex hex = brick.hex;
    for (int& n : hex) n += static_cast<int>(mesh.points.size());
    mesh.hexes.push_back(hex);
    mesh.points.insert(mesh.points.end(), brick.points.begin(), brick.points.end());
  }
  const ShapeSummary s = summarise_shape(mesh);
  EXPECT_DOUBLE_EQ(s.edge_ratio.min, 1);
  EXPECT_DOUBLE_EQ(s.edge_ratio.mean, 3);
  EXPECT_DOUBLE_EQ(s.edge_ratio.max, 6);
  EXPECT_NEAR(s.skew.max, 0, 1e-15);
  EXPECT_EQ(summarise_shape({}).edge_ratio.max, 0);
}

TEST(Quality, ACellCanBeInvertedInsideOnly) {
  const Cell brick = cell([](const Vec3& p) { return Vec3(2 * p[0], 3 * p[1], 8 * p[2]); });
  EXPECT_NEAR(least_inner_determinant(brick.points, brick.hex), 48.0 / 8, 1e-12);
  EXPECT_NEAR(hex_volume(brick.points, brick.hex), 48, 1e-12);
  const Cell warped{{{-0.4, 0, -0.8}, {0.8, -0.3, -0.7}, {0.3, 0.8, 0.6}, {0.9, 0.6, 0.4}, {0, 0.5, 1.2}, {1.6, -0.4, 1.2}, {1.8, 1.4, 0.6}, {-0.5, 1.9, 0.7}},
                    brick.hex};
  EXPECT_GT(scaled_jacobian(warped.points, warped.hex), 0.2);
  EXPECT_LT(least_inner_determinant(warped.points, warped.hex), -0.01);
}

}  // namespace
}  // namespace polycube
