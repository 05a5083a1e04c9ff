#include "deform/deform.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <memory>
#include <set>

#include "core/charts.h"
#include "core/error.h"
#include "deform/foldover.h"
#include "support/tet_grid.h"

namespace polycube {
namespace {

double tet_volume(const std::vector<Vec3>& p, const Tet& t) { return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).dot(p[t[3]] - p[t[0]]) / 6; }

std::vector<int> box_labels(const TetMesh& mesh) {
  std::vector<int> labels;
  for (int f : mesh.triangle_face) labels.push_back(f - 1);
  return labels;
}

TEST(Deform, ABoxInItsOwnFrameStaysAsItIs) {
  TetMesh mesh = tet_grid(3, 4, 5);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& p : mesh.points) p = turn.transpose() * p + Vec3(10, -20, 30);
  DeformReport report;
  const PolycuboidMap map = deform(mesh, turn, box_labels(mesh), {}, {}, Monitor(), &report);
  EXPECT_EQ(map.charts.size(), 6u);
  EXPECT_EQ(report.flipped, 0);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_LT(((map.image[i] - map.image[0]) - turn * (mesh.points[i] - mesh.points[0])).norm(), 1e-5);
  }
}

TEST(Deform, ChartsOfABentBoxBecomeExactPlanesWithoutFolds) {
  TetMesh mesh = tet_grid(4, 4, 8);
  for (Vec3& p : mesh.points) {
    const double a = 0.12 * p[2];
    p = Vec3((p[0] + 6) * std::cos(a), p[1], (p[0] + 6) * std::sin(a));
  }
  // The bend turns z to the angle; (radius, y, angle) is right-handed as (x, y, z) was.
  for (const Tet& t : mesh.tets) ASSERT_GT(tet_volume(mesh.points, t), 0);
  DeformReport report;
  const PolycuboidMap map = deform(mesh, Mat3::Identity(), box_labels(mesh), {}, {}, Monitor(), &report);
  EXPECT_EQ(report.flipped, 0);
  for (const Chart& c : map.charts) {
    for (int n : c.nodes) EXPECT_EQ(map.image[n][c.axis], c.value);
  }
  for (const Tet& t : mesh.tets) EXPECT_GT(tet_volume(map.image, t), 0);
}

TEST(Deform, AFeatureSharesItsCoordinate) {
  const TetMesh mesh = tet_grid(4, 4, 4);
  // A wavy line across the top becomes straight.
  Chart feature;
  feature.axis = 0;
  for (int j = 0; j <= 4; ++j) feature.nodes.push_back((j % 2 == 0 ? 2 : 1) + 5 * (j + 5 * 4));
  std::sort(feature.nodes.begin(), feature.nodes.end());
  const PolycuboidMap map = deform(mesh, Mat3::Identity(), box_labels(mesh), {feature}, {}, Monitor());
  ASSERT_EQ(map.charts.size(), 7u);
  for (int n : feature.nodes) EXPECT_EQ(map.image[n][0], map.charts[6].value);
  EXPECT_GT(map.charts[6].value, map.image[0][0]);
}

TEST(Deform, ChartsCloserThanMergeShareAPlane) {
  TetMesh mesh = tet_grid(2, 1, 2);
  // The top's right half is lifted a little and gets a chart of its own through a sliver of another label between.
  for (Vec3& p : mesh.points) {
    if (p[2] == 2 && p[0] == 2) p[2] += 0.01;
  }
  DeformOptions options;
  options.merge = 0.5;
  const PolycuboidMap map = deform(mesh, Mat3::Identity(), box_labels(mesh), {}, options, Monitor());
  std::set<double> heights;
  for (const Chart& c : map.charts) {
    if (c.axis == 2) heights.insert(c.value);
  }
  EXPECT_EQ(heights.size(), 2u);
}

TEST(Deform, OneLabelAllOverLeavesNoRoom) {
  const TetMesh mesh = tet_grid(1, 1, 1);
  const std::vector<int> labels(mesh.triangles.size(), 0);
  EXPECT_THROW(deform(mesh, Mat3::Identity(), labels, {}, {}, Monitor()), StageFailed);
}

TEST(Deform, CancelStopsIt) {
  const TetMesh mesh = tet_grid(2, 2, 2);
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(deform(mesh, Mat3::Identity(), box_labels(mesh), {}, {}, monitor), Cancelled);
}

// One node thrown out of the box comes back, and nothing shrinks for it.
TEST(Foldovers, ADeepFoldOpensAndThePartKeepsItsSize) {
  const TetMesh mesh = tet_grid(6, 6, 6);
  std::vector<Element> elements;
  for (const Tet& t : mesh.tets) elements.push_back(make_element(mesh.points, t));
  std::array<UnionFind, 3> groups{UnionFind(mesh.points.size()), UnionFind(mesh.points.size()), UnionFind(mesh.points.size())};
  for (const Chart& c : find_charts(mesh.triangles, box_labels(mesh))) {
    for (int n : c.nodes) groups[c.axis].unite(c.nodes.front(), n);
  }
  std::array<std::unique_ptr<Coordinate>, 3> system;
  for (int d = 0; d < 3; ++d) system[d] = std::make_unique<Coordinate>(mesh, elements, groups[d]);
  std::vector<Vec3> image = mesh.points;
  for (Vec3& p : image) {
    if ((p - Vec3(3, 3, 3)).norm() < 1e-9) p += Vec3(8, 5, 3);
  }
  const FoldoverReport report = remove_foldovers(mesh, elements, system, image, 1, Monitor());
  EXPECT_EQ(report.flipped, 0);
  Vec3 low = image[0], high = image[0];
  for (const Vec3& p : image) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_GT((high - low).minCoeff(), 3);
}

}  // namespace
}  // namespace polycube
