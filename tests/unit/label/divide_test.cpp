#include "label/divide.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "core/charts.h"
#include "label/label.h"
#include "support/shapes.h"
#include "tet/tet.h"

namespace polycube {
namespace {

TetMesh tets_of(const CadModel& model) {
  TetOptions options;
  options.size = model.diagonal() / 20;
  return tetrahedralise(model, options, Monitor());
}

TEST(PlaneCuts, DivideBetweenTheAxesThatThePlaneFaces) {
  const Vec3 oblique = Vec3(1, 1, 1).normalized(), slope = Vec3(1, 0, 1).normalized();
  EXPECT_EQ(plane_cuts(oblique, {}).size(), 10u);
  ASSERT_EQ(plane_cuts(slope, {}).size(), 3u);
  EXPECT_TRUE(plane_cuts(Vec3::UnitZ(), {}).empty());
  for (const FaceCut& c : plane_cuts(slope, {})) {
    EXPECT_NEAR(c.across.dot(slope), 0, 1e-12);
    EXPECT_NEAR(c.across[1], 0, 1e-12);  // the line runs along y
  }
}

TEST(PlaneCuts, DivideBetweenVerticesThatLeaveRoom) {
  const Vec3 slope = Vec3(1, 0, 1).normalized(), across = plane_cuts(slope, {}).front().across;
  std::vector<Vec3> vertices;
  for (const double at : {0.0, 10.0, 2.0, 2.5, 10.0}) vertices.emplace_back(at * across + Vec3(0, 3, 0));
  const std::vector<FaceCut> cuts = plane_cuts(slope, vertices);
  ASSERT_EQ(cuts.size(), 5u);
  EXPECT_NEAR(cuts[3].share, 0.1, 1e-12);
  EXPECT_NEAR(cuts[4].share, 0.625, 1e-12);
  for (std::size_t i = 0; i < cuts.size(); ++i) EXPECT_EQ(cuts[i].exact, i >= 3);
}

TEST(CutFaces, LeavesNoTriangleOnBothSidesAndTheRestAlone) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 4));
  const TetMesh before = tets_of(model);
  int bevel = 0;
  for (const int f : model.faces()) bevel = model.face(f).axis.cwiseAbs().maxCoeff() < 0.9 ? f : bevel;
  ASSERT_GT(bevel, 0);
  std::vector<FaceCut> cuts(static_cast<std::size_t>(model.face_count()) + 1);
  cuts[bevel] = {.across = Vec3(1, -1, 0).normalized(), .share = 0.03, .exact = true};
  const TetMesh mesh = cut_faces(before, cuts, Mat3::Identity(), Monitor());
  EXPECT_GT(mesh.triangles.size(), before.triangles.size());
  double low = std::numeric_limits<double>::infinity(), high = -low, narrow = 0;
  const auto along = [&](int n) { return cuts[bevel].across.dot(mesh.points[n]); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.triangle_face[t] != bevel) continue;
    for (int n : mesh.triangles[t]) {
      low = std::min(low, along(n));
      high = std::max(high, along(n));
    }
  }
  const double middle = low + 0.03 * (high - low);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (mesh.triangle_face[t] != bevel) continue;
    const auto [least, most] = std::minmax({along(a), along(b), along(c)});
    EXPECT_TRUE(least > middle - 1e-9 || most < middle + 1e-9);
    if (most < middle + 1e-9) narrow += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm() / 2;
  }
  EXPECT_NEAR(narrow, 0.03 * 10 * std::sqrt(2.0) * 4, 1e-6);
  for (std::size_t f = 1; f < cuts.size(); ++f) cuts[f] = {};
  EXPECT_EQ(cut_faces(before, cuts, Mat3::Identity(), Monitor()).points.size(), before.points.size());
}

TEST(Thirds, FaceTheirAxesAndMeetInTheMiddle) {
  for (const Vec3& way : {Vec3(1, 1, 1), Vec3(-1, 2, 1), Vec3(1, -1, -2)}) {
    const Vec3 normal = way.normalized();
    for (int k = 0; k < 3; ++k) {
      // Up the plane in the direction that its normal has along the axis.
      const Vec3 up = (normal[k] < 0 ? -1 : 1) * (Vec3::Unit(k) - normal[k] * normal);
      EXPECT_EQ(third_at(normal, up), k);
      for (int other = 0; other < 3; ++other) {
        if (other == k) continue;
        EXPECT_GT(third_side(normal, up, k, other), 0);
        EXPECT_NEAR(third_side(normal, up, k, other), -third_side(normal, up, other, k), 1e-12);
        // The border runs along the third axis.
        EXPECT_NEAR(third_side(normal, Vec3::Unit(3 - k - other) - normal[3 - k - other] * normal, k, other), 0, 1e-12);
      }
    }
  }
}

TEST(BentCuts, GoAcrossTheAxisAlongWhichTheNormalTurns) {
  const std::vector<FaceCut> cuts = bent_cuts(Vec3::UnitY(), Vec3(0.5, 0.1, 0));
  ASSERT_FALSE(cuts.empty());
  for (const FaceCut& c : cuts) {
    EXPECT_EQ(c.across, Vec3::UnitX());
    EXPECT_TRUE(c.share > 0 && c.share < c.upper && c.upper <= 1 && !c.thirds);
  }
  EXPECT_EQ(std::count_if(cuts.begin(), cuts.end(), [](const FaceCut& c) { return c.upper < 1; }), 1);
  EXPECT_EQ(bent_cuts(Vec3::UnitZ(), Vec3(0.1, 0.4, 0)).front().across, Vec3::UnitY());
  EXPECT_TRUE(bent_cuts(Vec3::UnitY(), Vec3(0.01, 0, 0.02)).empty());
}

// The chord has no second label: the arc needs three.
TEST(BentCuts, MakeABoredHalfOfALensValid) {
  const CadModel model = CadModel::from_brep(shapes::half_lens(40, 15));
  TetMesh mesh = tets_of(model);
  LabelReport report;
  const Labelling result = label(model, mesh, {}, Monitor(), &report);
  EXPECT_EQ(report.score, 0);
  std::map<int, std::set<int>> labels;
  for (std::size_t t = 0; t < result.label.size(); ++t) labels[mesh.triangle_face[t]].insert(result.label[t]);
  for (const int f : model.faces()) {
    if (model.face(f).kind == SurfaceKind::kPlane) {
      EXPECT_EQ(labels[f].size(), 1u);
    } else if (model.face(f).radius > 20) {
      EXPECT_EQ(labels[f].size(), 3u);
    }
  }
}

// Two arcs that meet in two sharp edges: each must take a second label, or labels of one axis meet there.
TEST(BentCuts, MakeALensValid) {
  for (const double height : {4.0, 30.0}) {
    const CadModel model = CadModel::from_brep(shapes::lens(20, height));
    TetMesh mesh = tets_of(model);
    LabelReport report;
    const Labelling labelling = label(model, mesh, LabelOptions(), Monitor(), &report);
    EXPECT_TRUE(report.valid()) << height;
    EXPECT_EQ(report.turning_points, 0) << height;
    EXPECT_EQ(std::set<int>(labelling.label.begin(), labelling.label.end()).size(), 6u) << height;
  }
}

TEST(ConeCuts, AcrossAnAxisOfTheFrameWhereTheConeIsOblique) {
  const std::vector<FaceCut> cuts = cone_cuts(-Vec3::UnitZ(), 0.7);
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_NE(cuts[0].level, cuts[1].level);
  for (const FaceCut& c : cuts) {
    EXPECT_EQ(c.across, Vec3::UnitZ());
    EXPECT_NE(c.level, ConePart::kNone);
  }
  EXPECT_TRUE(cone_cuts(Vec3::UnitZ(), 0.05).empty());    // all but a cylinder
  EXPECT_TRUE(cone_cuts(Vec3::UnitZ(), -0.999).empty());  // all but a disc
  EXPECT_TRUE(cone_cuts(Vec3(1, 0, 1).normalized(), 0.7).empty());
}

// Rings with three sides: a cone must face along the axis and sideways, or labels of one axis meet.
TEST(ConeCuts, MakeRingsOfTriangularSectionValid) {
  for (const std::string& ring : {shapes::weld(6, 3, 3), shapes::weld(6, 2, 4), shapes::wedge_ring(10, 2, 4), shapes::wedge_ring(10, 3, 3)}) {
    const CadModel model = CadModel::from_brep(ring);
    TetMesh mesh = tets_of(model);
    LabelReport report;
    const Labelling labelling = label(model, mesh, LabelOptions(), Monitor(), &report);
    EXPECT_TRUE(report.valid());
    EXPECT_EQ(report.turning_points, 0);
    std::size_t most = 0;  // labels of a cone
    for (const int f : model.faces()) {
      std::set<int> labels;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (model.face(f).kind == SurfaceKind::kCone && mesh.triangle_face[t] == f) labels.insert(labelling.label[t]);
      most = std::max(most, labels.size());
    }
    EXPECT_EQ(most, 5u);
  }
}

TEST(DivideTips, InQuartersRoundTheAxisAndInHalvesUpIt) {
  const CadModel model = CadModel::from_brep(shapes::cone(5, 0, 12));
  const TetMesh mesh = tets_of(model);
  const Tips tips = divide_tips(model, mesh, Mat3::Identity(), Monitor());
  ASSERT_TRUE(tips.any);
  std::map<int, double> area;
  std::set<int> at_tip;
  for (std::size_t t = 0; t < tips.mesh.triangles.size(); ++t) {
    if (tips.label[t] < 0) continue;
    const auto& [a, b, c] = tips.mesh.triangles[t];
    const std::vector<Vec3>& p = tips.mesh.points;
    area[tips.label[t] + (tips.upper[t] ? 10 : 0)] += (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    const bool tip = p[a][2] > 12 - 1e-9 || p[b][2] > 12 - 1e-9 || p[c][2] > 12 - 1e-9;
    if (tip) at_tip.insert(tips.label[t]);
    const Vec3 middle = (p[a] + p[b] + p[c]) / 3;
    EXPECT_GT(label_sign(tips.label[t]) * middle[label_axis(tips.label[t])], 0);
  }
  ASSERT_EQ(area.size(), 8u);  // four quarters, two halves
  EXPECT_EQ(at_tip, (std::set<int>{0, 1, 2, 3}));
  for (const auto& [piece, size] : area) EXPECT_NEAR(size / (std::numbers::pi * 5 * 13 / 4), piece >= 10 ? 0.25 : 0.75, 0.05) << piece;
}

TEST(DivideTips, NotAtThePolesOfASphere) {
  const CadModel model = CadModel::from_brep(shapes::sphere(5));
  EXPECT_FALSE(divide_tips(model, tets_of(model), Mat3::Identity(), Monitor()).any);
}

}  // namespace
}  // namespace polycube
