#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/quality.h"
#include "fit/fit.h"
#include "pad/pad.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

double distance_to_cad(const CadModel& model, const HexMesh& mesh, const Association& a) {
  double worst = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const CadRef& cad = a.point_cad[v];
    double off = 0;
    if (cad.dim == 0) off = (mesh.points[v] - model.vertex(cad.id)).norm();
    if (cad.dim == 1) off = model.project_to_edge(cad.id, mesh.points[v]).distance;
    if (cad.dim == 2) off = model.project_to_face(a.patches[cad.id][0], mesh.points[v]).distance;
    worst = std::max(worst, off);
  }
  return worst;
}

// Throws every node about by up to `size`.
void shake(HexMesh& mesh, double size) {
  std::mt19937 random(7);
  for (Vec3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) p[k] += size * (static_cast<double>(random() % 2001) / 1000 - 1);
  }
}

PaddedMesh padded(const Grid& grid) { return pad(CadModel::from_brep(grid.brep), grid.mesh, grid.association, Monitor{}); }

// The least that the shapes reach; without the last step, by the worst corner of each cell, most stay below.
struct Case {
  const char* name;
  Grid (*make)();
  double min_quality, mean_quality;
};

class FitShapes : public ::testing::TestWithParam<Case> {};

TEST_P(FitShapes, UntanglesAShakenMeshOntoTheCad) {
  const Case& c = GetParam();
  const Grid grid = c.make();
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh p = padded(grid);
  shake(p.mesh, 0.1);
  ASSERT_GT(summarise(p.mesh).inverted, 0);
  const FitReport report = fit(model, p.mesh, p.association, {}, Monitor{});
  EXPECT_EQ(report.inverted, 0);
  EXPECT_TRUE(report.bad_faces.empty());
  EXPECT_GE(report.min_scaled_jacobian, c.min_quality);
  EXPECT_GE(report.mean_scaled_jacobian, c.mean_quality);
  EXPECT_LE(distance_to_cad(model, p.mesh, p.association), 1e-9 * model.diagonal());
  EXPECT_LE(report.max_off, 1e-9 * model.diagonal());
  EXPECT_DOUBLE_EQ(summarise(p.mesh).min_scaled_jacobian, report.min_scaled_jacobian);
}

INSTANTIATE_TEST_SUITE_P(Grids, FitShapes,
                         ::testing::Values(Case{"box", [] { return box_grid(4); }, 0.95, 0.99}, Case{"l", [] { return l_grid(4); }, 0.9, 0.98},
                                           Case{"plate", [] { return plate_grid(6); }, 0.905, 0.9875},
                                           Case{"cylinder", [] { return cylinder_grid(6); }, 0.85, 0.9675},
                                           Case{"ball", [] { return ball_grid(6); }, 0.765, 0.93}, Case{"boss", [] { return boss_grid(6); }, 0.84, 0.9785},
                                           Case{"fillet", [] { return filleted_grid(8); }, 0.6, 0.93},
                                           Case{"imprint", [] { return imprint_grid(16); }, 0.54, 0.925}),
                         [](const auto& tested) { return tested.param.name; });

// Nothing that was reached is given up for something else: neither the worst cell, but for what holds it within 2 %, nor the mean.
TEST(Fit, AFittedMeshBecomesNoWorse) {
  for (Grid (*make)() : {+[] { return plate_grid(6); }, +[] { return boss_grid(6); }, +[] { return imprint_grid(16); }}) {
    const Grid grid = make();
    const CadModel model = CadModel::from_brep(grid.brep);
    PaddedMesh p = padded(grid);
    const FitReport first = fit(model, p.mesh, p.association, {}, Monitor{});
    const FitReport second = fit(model, p.mesh, p.association, {}, Monitor{});
    EXPECT_GE(second.min_scaled_jacobian, 0.98 * first.min_scaled_jacobian);
    EXPECT_GE(second.mean_scaled_jacobian, first.mean_scaled_jacobian - 1e-3);
  }
}

TEST(Fit, DoesNotDependOnTheNumberOfThreads) {
  const Grid grid = filleted_grid(12);
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh p = padded(grid);
  shake(p.mesh, 0.05);
  HexMesh one = p.mesh, three = p.mesh;
  FitOptions options;
  options.max_rounds = 5;
  options.threads = 1;
  fit(model, one, p.association, options, Monitor{});
  options.threads = 3;
  fit(model, three, p.association, options, Monitor{});
  for (std::size_t v = 0; v < one.points.size(); ++v) ASSERT_EQ(one.points[v], three.points[v]) << v;
}

TEST(Fit, FollowsARigidMotionAndAScale) {
  const Grid grid = cylinder_grid(4);
  PaddedMesh p = padded(grid);
  HexMesh plain = p.mesh, moved = p.mesh;
  const double factor = 25;
  const Eigen::AngleAxisd turn(40 * std::numbers::pi / 180, Vec3(1, 2, 3).normalized());
  const Vec3 shift(300, -20, 7);
  for (Vec3& x : moved.points) x = turn * (factor * x) + shift;
  const CadModel model = CadModel::from_brep(grid.brep);
  const CadModel moved_model = CadModel::from_brep(shapes::moved(shapes::scaled(grid.brep, factor), 40, shift[0], shift[1], shift[2]));
  const FitReport first = fit(model, plain, p.association, {}, Monitor{});
  const FitReport second = fit(moved_model, moved, p.association, {}, Monitor{});
  EXPECT_EQ(second.inverted, 0);
  EXPECT_NEAR(first.min_scaled_jacobian, second.min_scaled_jacobian, 0.02);
  EXPECT_NEAR(first.mean_scaled_jacobian, second.mean_scaled_jacobian, 0.005);
}

// Cells that span 180 degrees of a cylinder: no move of nodes makes them good, and the report says so.
TEST(Fit, ReportsWhatItCannotMend) {
  Grid grid = cylinder_grid(8);
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh layered = padded(grid);
  const FitReport bare = fit(model, grid.mesh, grid.association, {}, Monitor{});
  EXPECT_LT(bare.min_scaled_jacobian, fit(model, layered.mesh, layered.association, {}, Monitor{}).min_scaled_jacobian - 0.1);
  EXPECT_DOUBLE_EQ(summarise(grid.mesh).min_scaled_jacobian, bare.min_scaled_jacobian);
  EXPECT_EQ(summarise(grid.mesh).inverted, bare.inverted);
}

// A cylinder without a layer and with one, in either order: the layered one is fitted first, to the same places as alone, and suffices.
TEST(Fit, BeginsWithTheMostPromisingOfSeveral) {
  const Grid grid = cylinder_grid(8);
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh alone = padded(grid);
  const FitReport expected = fit(model, alone.mesh, alone.association, {}, Monitor{});
  for (const bool layered_first : {true, false}) {
    PaddedMesh bare{grid.mesh, grid.association}, layered = padded(grid);
    const FitCandidate with{layered.mesh, layered.association}, without{bare.mesh, bare.association};
    const std::vector<FitCandidate> candidates = layered_first ? std::vector{with, without} : std::vector{without, with};
    const auto good = [&](std::size_t, const FitReport& r) { return r.min_scaled_jacobian >= expected.min_scaled_jacobian; };
    const FitChoice choice = fit_best(model, candidates, {}, 2, good, Monitor{});
    EXPECT_EQ(choice.index, layered_first ? 0u : 1u);
    EXPECT_EQ(choice.fitted, 1);
    EXPECT_EQ(choice.report.min_scaled_jacobian, expected.min_scaled_jacobian);
    EXPECT_EQ(layered.mesh.points, alone.mesh.points);
  }
  // Where nothing is good enough all are fitted, and the best counts.
  PaddedMesh bare{grid.mesh, grid.association}, layered = padded(grid);
  const FitChoice choice = fit_best(
      model, {{bare.mesh, bare.association}, {layered.mesh, layered.association}}, {}, 2, [](std::size_t, const FitReport&) { return false; }, Monitor{});
  EXPECT_EQ(choice.index, 1u);
  EXPECT_EQ(choice.fitted, 2);
}

TEST(Fit, StopsWhenCancelled) {
  Grid grid = box_grid(4);
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(fit(CadModel::from_brep(grid.brep), grid.mesh, grid.association, {}, monitor), Cancelled);
}

// A cell as good as the narrow angle between two CAD edges lets it be does not count.
TEST(Fit, CellsInNarrowCornersOfTheCadAreHeld) {
  HexMesh mesh{{}, {{0, 1, 2, 3, 4, 5, 6, 7}}};
  for (double z : {0, 1}) {
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.1, 0.12), std::pair(0.98, 0.2)}) mesh.points.emplace_back(x, y, z);
  }
  Association association;
  for (const auto& [c, d] : kHexEdges) association.segments.push_back({c, d});
  association.segment_edge.assign(association.segments.size(), 7);
  const double narrow = std::sin(std::atan2(0.2, 0.98));
  EXPECT_NEAR(summarise(mesh).min_scaled_jacobian, narrow, 1e-12);
  EXPECT_EQ(free_scaled_jacobian(mesh, association), 1);  // the only cell is held
  association.segments.clear();
  EXPECT_NEAR(free_scaled_jacobian(mesh, association), narrow, 1e-12);
}

// Of a prism over a quadrilateral with a corner of 12.5 degrees one cell is the best there is; a cell that leaves a part of the corner empty is not.
TEST(Fit, AnAngleOfTheCadBoundsTheWorstCell) {
  const shapes::Prism above{2, {{0, 0}, {0.9, 0.2}, {1, 0.15}, {2, 0.15}, {2, 2}, {-1, 2}, {-1, 0}}, 0, 1};
  const CadModel model = CadModel::from_brep(shapes::machined_box(1, {above}));
  HexMesh mesh{{}, {{0, 1, 2, 3, 4, 5, 6, 7}}};
  for (const double z : {0, 1}) {
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.0, 0.15), std::pair(0.9, 0.2)}) mesh.points.emplace_back(x, y, z);
  }
  Association association;
  for (const Vec3& p : mesh.points) {
    for (const int v : model.vertices()) {
      if ((model.vertex(v) - p).norm() < 1e-9) association.point_cad.push_back({0, v});
    }
  }
  ASSERT_EQ(association.point_cad.size(), 8u);
  for (const auto& [c, d] : kHexEdges) {
    const std::array<int, 2> ends{association.point_cad[c].id, association.point_cad[d].id};
    for (const int e : model.edges()) {
      const std::array<int, 2> of = model.edge(e).vertices;
      if (of != ends && of != std::array{ends[1], ends[0]}) continue;
      association.segments.push_back({c, d});
      association.segment_edge.push_back(e);
    }
  }
  ASSERT_EQ(association.segments.size(), 12u);
  EXPECT_NEAR(summarise(mesh).min_scaled_jacobian, std::sin(std::atan2(0.2, 0.9)), 1e-9);
  EXPECT_TRUE(at_cad_bound(model, mesh, association));
  mesh.points[3] = mesh.points[7] = {0.95, 0.12, 0};
  mesh.points[7][2] = 1;
  EXPECT_FALSE(at_cad_bound(model, mesh, association));
}

// So does one that fills a narrow angle between the two CAD faces of an edge, as far from the ends of the edge as may be.
TEST(Fit, CellsBetweenCadFacesAtANarrowAngleAreHeld) {
  HexMesh mesh{{}, {{0, 1, 2, 3, 4, 5, 6, 7}}};
  for (const double z : {0, 1}) {
    for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(1.1, 0.12), std::pair(0.98, 0.2)}) mesh.points.emplace_back(x, y, z);
  }
  const double narrow = std::sin(std::atan2(0.2, 0.98));
  Association association;
  association.segments.push_back({4, 0});
  association.segment_edge = {7};
  association.quads = {{0, 1, 5, 4}, {3, 0, 4, 7}};
  EXPECT_EQ(free_scaled_jacobian(mesh, association), 1);
  association.quads.pop_back();  // material goes on beyond the cell
  EXPECT_NEAR(free_scaled_jacobian(mesh, association), narrow, 1e-12);
  association.quads.push_back({3, 0, 4, 7});
  association.segments.clear();  // both quads are of one smooth face
  EXPECT_NEAR(free_scaled_jacobian(mesh, association), narrow, 1e-12);
}

}  // namespace
}  // namespace polycube
