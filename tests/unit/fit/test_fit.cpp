#include <gtest/gtest.h>

#include <random>

#include "core/quality.h"
#include "fit/fit.h"
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

struct Case {
  const char* name;
  Grid (*make)(int);
  int cells;
  double min_quality, mean_quality;
};

class FitShapes : public ::testing::TestWithParam<Case> {};

TEST_P(FitShapes, UntanglesAShakenMeshOntoTheCad) {
  const Case& c = GetParam();
  Grid grid = c.make(c.cells);
  const CadModel model = model_of(grid.shape);
  shake(grid.mesh, 0.15);
  ASSERT_GT(summarise(grid.mesh).inverted, 0);
  const FitReport report = fit(model, grid.mesh, grid.association, {}, Monitor{});
  EXPECT_EQ(report.inverted, 0);
  EXPECT_GE(report.min_scaled_jacobian, c.min_quality);
  EXPECT_GE(report.mean_scaled_jacobian, c.mean_quality);
  EXPECT_LE(distance_to_cad(model, grid.mesh, grid.association), 1e-9 * model.diagonal());
  EXPECT_DOUBLE_EQ(summarise(grid.mesh).min_scaled_jacobian, report.min_scaled_jacobian);
}

INSTANTIATE_TEST_SUITE_P(Grids, FitShapes,
                         ::testing::Values(Case{"box", box_grid, 4, 0.95, 0.99}, Case{"l", l_grid, 4, 0.9, 0.98}, Case{"plate", plate_grid, 6, 0.6, 0.9}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace polycube
