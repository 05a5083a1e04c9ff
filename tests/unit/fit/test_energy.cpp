#include <gtest/gtest.h>

#include <numeric>

#include "fit/energy.h"
#include "support/grids.h"

namespace polycube {
namespace {

// A box whose layers of cells along x are 0.01, 0.49, 0.25, ... thick: every cell has the best scaled Jacobian there is.
TEST(Descent, EdgesDoNotCollapseForTheSakeOfTheScaledJacobian) {
  testing::Grid grid = testing::box_grid(4);
  for (Vec3& p : grid.mesh.points) {
    if (std::abs(p[0] - 0.25) < 1e-9) p[0] = 0.01;
  }
  const CadModel model = CadModel::from_brep(grid.brep);
  const HexGraph graph = build_hex_graph(grid.mesh);
  Entities entities(model, grid.association, 1);
  entities.project(grid.mesh.points);
  const std::vector<Vec3> targets(grid.mesh.hexes.size(), Vec3::Constant(0.25));
  Region whole;
  whole.hexes.resize(grid.mesh.hexes.size());
  std::iota(whole.hexes.begin(), whole.hexes.end(), 0);
  for (int v = 0; v < static_cast<int>(grid.mesh.points.size()); ++v) {
    if (entities.dimension(v) != 0) whole.nodes.push_back(v);
  }
  const Monitor monitor;
  Descent(grid.mesh, graph, entities, 1, monitor).run({0, 1, 4, 0}, targets, whole, {}, 60);
  for (const Hex& h : grid.mesh.hexes) EXPECT_GT((grid.mesh.points[h[0]] - grid.mesh.points[h[1]]).norm(), 0.03);
}

}  // namespace
}  // namespace polycube
