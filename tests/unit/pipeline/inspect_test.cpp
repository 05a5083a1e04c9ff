#include "pipeline/inspect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "support/shapes.h"

namespace polycube {
namespace {

const CadModel& box() {
  static const CadModel model = CadModel::from_brep(shapes::box(10, 10, 10));
  return model;
}

/// The labelled box, those triangles of its upper side relabelled +X whose middle `inside` says yes to.
LabelledPart relabelled(const std::function<bool(double, double)>& inside) {
  static const LabelledPart kPart = label_part(box(), MeshOptions(), Monitor(), Until::kLabels);
  LabelledPart part = kPart;
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (int n : part.tets.triangles[t]) middle += part.tets.points[n] / 3;
    if (middle[2] > 10 - 1e-6 && inside(middle[0], middle[1])) part.labelling.label[t] = 0;
  }
  return part;
}

TEST(Inspect, ABox) {
  const LabelledPart part = relabelled([](double, double) { return false; });
  const Inspection found = inspect(part);
  EXPECT_TRUE(found.violations.valid());
  EXPECT_EQ(found.charts, 6);
  EXPECT_EQ(found.boundaries, 12);
  EXPECT_EQ(found.corners.size(), 8u);
  EXPECT_TRUE(found.turning_points.empty());
  EXPECT_TRUE(found.stray_charts.empty());
  EXPECT_TRUE(found.zigzags.empty());
  const EdgeTable edges = edge_table(part);
  EXPECT_EQ(edges.edges, 12);
  EXPECT_EQ(edges.boundary, 12);
  const std::vector<int> labels = face_labels(part, 6);
  for (int f = 1; f <= 6; ++f) {
    const Vec3 n = part.labelling.frame * box().face(f).axis;
    EXPECT_GT((labels[f] % 2 == 0 ? 1 : -1) * n[labels[f] / 2], 0.99);
  }
}

TEST(Inspect, AStrayTriangleIsFound) {
  bool done = false;
  const LabelledPart part = relabelled([&](double x, double y) {
    const bool here = !done && std::abs(x - 5) < 1 && std::abs(y - 5) < 1;
    done |= here;
    return here;
  });
  ASSERT_TRUE(done);
  const Inspection found = inspect(part);
  EXPECT_FALSE(found.violations.valid());
  EXPECT_EQ(found.charts, 7);
  ASSERT_EQ(found.stray_charts.size(), 1u);
  EXPECT_EQ(std::count(found.chart.begin(), found.chart.end(), found.stray_charts[0]), 1);
}

// A hook: its border runs along Y, back, and on again.
TEST(Inspect, ATurningPointIsWhereTheBorderReverses) {
  const LabelledPart straight = relabelled([](double x, double) { return x > 6; });
  EXPECT_TRUE(inspect(straight).turning_points.empty());
  EXPECT_EQ(inspect(straight).charts, 6);
  const LabelledPart hook = relabelled([](double x, double y) { return x > 6 || (x > 2 && y > 6 && y < 8) || (x > 2 && x < 4 && y > 3 && y < 8); });
  const Inspection found = inspect(hook);
  EXPECT_TRUE(found.violations.valid());
  EXPECT_EQ(found.violations.turning_points, 1);
  ASSERT_EQ(found.turning_points.size(), 1u);
  const Vec3& p = hook.tets.points[found.turning_points[0]];
  EXPECT_NEAR(p[1], 6, 1);
  EXPECT_NEAR(p[2], 10, 1e-6);
  EXPECT_FALSE(found.zigzags.empty());
}

TEST(Inspect, TheReportReadsBack) {
  const LabelledPart part = relabelled([](double, double) { return false; });
  const auto json = nlohmann::json::parse(report_json("box", Assembly{{box()}, {""}, {}}, part, inspect(part)));
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["counts"]["charts"], 6);
  EXPECT_EQ(json["edges"]["total"], 12);
  EXPECT_EQ(json["faces"].size(), 6u);
}

}  // namespace
}  // namespace polycube
