#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/quality.h"
#include "fit/energy.h"
#include "support/grids.h"

namespace polycube {
namespace {

// A unit box of 4^3 cells whose first inner layer of nodes along x, at 0.25, is moved to `layer`.
testing::Grid uneven_box(double layer) {
  testing::Grid grid = testing::box_grid(4);
  for (Vec3& p : grid.mesh.points) {
    if (std::abs(p[0] - 0.25) < 1e-9) p[0] = layer;
  }
  return grid;
}

// Every cell, and every node that may move, wanted edge lengths those of even cells.
void descend(testing::Grid& grid, const Energy& energy, const std::vector<Turn>& turns, int iterations) {
  const CadModel model = CadModel::from_brep(grid.brep);
  const HexGraph graph = build_hex_graph(grid.mesh);
  Entities entities(model, grid.association, 1);
  entities.project(grid.mesh.points);
  const std::vector<Vec3> targets(grid.mesh.hexes.size(), Vec3::Constant(0.25));
  CellRegion whole;
  whole.hexes.resize(grid.mesh.hexes.size());
  std::iota(whole.hexes.begin(), whole.hexes.end(), 0);
  for (int v = 0; v < static_cast<int>(grid.mesh.points.size()); ++v) {
    if (entities.dimension(v) != 0) whole.nodes.push_back(v);
  }
  const Monitor monitor;
  Descent(grid.mesh, graph, entities, 1, monitor).run(energy, targets, whole, turns, {}, iterations);
}

// A box whose layers of cells along x are 0.01, 0.49, 0.25, ... thick: every cell has the best scaled Jacobian there is.
TEST(Descent, EdgesDoNotCollapseForTheSakeOfTheScaledJacobian) {
  testing::Grid grid = uneven_box(0.01);
  descend(grid, {0, 1, 4}, {}, 60);
  for (const Hex& h : grid.mesh.hexes) EXPECT_GT((grid.mesh.points[h[0]] - grid.mesh.points[h[1]]).norm(), 0.03);
}

// The same box with a layer out of place, its CAD edges along x taken for arcs: their turns even the layers out, which no other term asks for.
TEST(Descent, TurnsSpreadTheNodesOfACurvedEdge) {
  const auto gap = [](bool curved) {
    testing::Grid grid = uneven_box(0.1);
    std::vector<Turn> turns;
    for (const auto& [a, b] : grid.association.segments) {
      const Vec3 along = grid.mesh.points[b] - grid.mesh.points[a];
      if (!curved || std::abs(along[0]) < 1e-9) continue;
      const Vec3 slope = 2 * along.normalized();  // radians per unit of length
      turns.push_back({{a, b}, {grid.mesh.points[a], grid.mesh.points[b]}, {-slope, slope}, 2 * along.norm()});
    }
    descend(grid, {0, 1, 8}, turns, 100);
    double least = 1;
    for (const auto& [a, b] : grid.association.segments) {
      const double length = std::abs((grid.mesh.points[b] - grid.mesh.points[a])[0]);
      if (length > 1e-9) least = std::min(least, length);
    }
    return least;
  };
  EXPECT_LT(gap(false), 0.19);
  EXPECT_GT(gap(true), 0.22);
}

// 3 x 3 x 3 cells, ready for a descent.
struct Box {
  testing::Grid grid = testing::box_grid(3);
  CadModel model = CadModel::from_brep(grid.brep);
  HexGraph graph = build_hex_graph(grid.mesh);
  Entities entities{model, grid.association, 1};
  std::vector<Vec3> targets = std::vector<Vec3>(grid.mesh.hexes.size(), Vec3::Constant(1.0 / 3));
  Monitor monitor;
  Box() { entities.project(grid.mesh.points); }
};

TEST(Descent, AFloorCostsAsItsFormulaSays) {
  Box box;
  auto& [grid, model, graph, entities, targets, monitor] = box;
  const CellRegion whole{{0}, {}};
  const auto energy = [&](double floor) { return Descent(grid.mesh, graph, entities, 1, monitor).run({0, 1, 2, floor}, targets, whole, {}, {}, 0).energy; };
  // At right angles (scaled Jacobian 1) the eight corners add 1 / floor^2 * floor^16 each.
  EXPECT_NEAR(energy(0.5) - energy(0), 8 * std::pow(0.5, 14), 1e-12);
  EXPECT_NEAR(energy(1.25) - energy(0), 8 * std::pow(1.25, 14), 1e-9);
}

// A cell with one corner pulled out of place, by the sum over its corners and by about the worst of them.
TEST(Descent, GatheredCornersCostAsTheirFormulaSays) {
  Box box;
  auto& [grid, model, graph, entities, targets, monitor] = box;
  const Hex& hex = grid.mesh.hexes[0];
  for (int v : hex) {
    if (entities.dimension(v) == 3) grid.mesh.points[v] += Vec3(0.1, 0.05, -0.08);
  }
  ASSERT_LT(scaled_jacobian(grid.mesh.points, hex), 0.95);
  const CellRegion whole{{0}, {}};
  const auto energy = [&](int gathered) {
    return Descent(grid.mesh, graph, entities, 1, monitor).run({.shape = 0, .right = 1, .gathered = gathered}, targets, whole, {}, {}, 0).energy;
  };
  double each = 0, all = 0;
  for (int c = 0; c < 8; ++c) {
    const double inverse = 1 / corner_scaled_jacobian(grid.mesh.points, hex, c);
    each += std::pow(inverse, 2);
    all += std::pow(inverse, 32) / 8;
  }
  EXPECT_NEAR(energy(32) - energy(0), 16.0 / 32 * std::log(all) - each, 1e-9);
}

// A box whose inner nodes are out of place: the worst corners come back to right angles.
TEST(Descent, GatheredCornersAreRaised) {
  testing::Grid grid = testing::box_grid(4);
  for (std::size_t v = 0; v < grid.mesh.points.size(); ++v) {
    if (grid.association.point_cad[v].dim == 3) grid.mesh.points[v] += Vec3(0.08 * (v % 3) - 0.08, 0.06 * (v % 2), -0.05);
  }
  const double before = summarise(grid.mesh).mean_scaled_jacobian;
  ASSERT_GT(summarise(grid.mesh).min_scaled_jacobian, 0);
  ASSERT_LT(before, 0.9);
  descend(grid, {.shape = 0.02, .right = 1, .gathered = 32}, {}, 100);
  EXPECT_GT(summarise(grid.mesh).min_scaled_jacobian, 0.99);
}

// All corners of this cell are good (scaled Jacobian 0.4), yet it is inverted inside.
TEST(Descent, WatchedCellsAreLookedAtInside) {
  Box box;
  auto& [grid, model, graph, entities, targets, monitor] = box;
  const std::array<Vec3, 8> hollow{Vec3(0.74, 0.09, 0.29),  Vec3(1.28, -0.21, 0.67), Vec3(1.06, 1.6, 0.34),  Vec3(0.05, 1.5, 0.61),
                                   Vec3(0.57, -0.03, 0.77), Vec3(0.63, -0.01, 0.78), Vec3(1.11, 1.61, 0.37), Vec3(1.23, 1.12, 2.01)};
  CellRegion region;
  for (int h = 0; h < static_cast<int>(grid.mesh.hexes.size()); ++h) {
    const Hex& hex = grid.mesh.hexes[h];
    if (std::any_of(hex.begin(), hex.end(), [&](int v) { return entities.dimension(v) < 3; })) continue;
    region.hexes = {h};
    region.nodes.assign(hex.begin(), hex.end());
    for (int c = 0; c < 8; ++c) grid.mesh.points[hex[c]] = hollow[c] / 3;
  }
  ASSERT_EQ(region.hexes.size(), 1u);
  std::sort(region.nodes.begin(), region.nodes.end());
  CellRegion watched = region;
  watched.watched = {1};
  Descent descent(grid.mesh, graph, entities, 1, monitor);
  EXPECT_GT(scaled_jacobian(grid.mesh.points, grid.mesh.hexes[region.hexes[0]]), 0.4);
  EXPECT_GT(descent.min_determinant(targets, region, {}), 0);
  EXPECT_LT(descent.min_determinant(targets, watched, {}), 0);
  EXPECT_TRUE(std::isfinite(descent.run({0, 1, 2}, targets, region, {}, {}, 0).energy));
  EXPECT_FALSE(std::isfinite(descent.run({0, 1, 2}, targets, watched, {}, {}, 0).energy));
  Energy energy;
  energy.eps = 0.1;
  descent.run(energy, targets, watched, {}, {}, 200);
  EXPECT_GT(descent.min_determinant(targets, watched, {}), 0);
  energy.eps = 0;
  descent.run(energy, targets, watched, {}, {}, 200);
  EXPECT_GT(scaled_jacobian(grid.mesh.points, grid.mesh.hexes[region.hexes[0]]), 0.999);
}

// Steps along curved entities stay on them to third order, and gradients by steps are those of the bent place.
TEST(Entities, StepsBendWithTheCad) {
  testing::Grid grid = testing::ball_grid(4);
  const CadModel model = CadModel::from_brep(grid.brep);
  Entities entities(model, grid.association, 1);
  entities.project(grid.mesh.points);
  int tried = 0;
  for (int v : entities.boundary()) {
    const Vec3 place = grid.mesh.points[v];
    const Vec3 step = entities.along(v, 0.1 * place.norm() * Vec3(0.6, -0.5, 0.3), Vec3::Zero());
    if (!(step.norm() > 0)) continue;
    ++tried;
    EXPECT_LT(entities.distance(v, place + entities.bent(v, step)), 0.1 * entities.distance(v, place + step) + 1e-12);
    EXPECT_NEAR(entities.turned(v, step), step.norm() / place.norm(), 1e-6);
    const Vec3 gradient(0.3, 0.8, -0.2);
    const double small = 1e-6;
    for (int k = 0; k < 3; ++k) {
      const Vec3 nudge = entities.along(v, small * Vec3::Unit(k), Vec3::Zero());
      const double slope = gradient.dot(entities.bent(v, step + nudge) - entities.bent(v, step - nudge)) / (2 * small);
      EXPECT_NEAR(entities.along(v, gradient, step)[k], slope, 1e-6);
    }
  }
  EXPECT_GT(tried, 20);
}

// A node of a face beyond the face's border, where no hex is inverted: the hexes beside it have room on the other side of the edge.
TEST(Descent, TheSkinKeepsNodesOfAFaceInsideItsBorder) {
  Box box;
  auto& [grid, model, graph, entities, targets, monitor] = box;
  // The middle of the part's edge along z on x = y = 0, and its neighbour on the face y = 0.
  const auto node_at = [&](const Vec3& p) {
    const auto it = std::find_if(grid.mesh.points.begin(), grid.mesh.points.end(), [&](const Vec3& q) { return (p - q).norm() < 1e-9; });
    return static_cast<int>(it - grid.mesh.points.begin());
  };
  const double h = 1.0 / 3;
  const int edge = node_at({0, 0, h}), next = node_at({h, 0, h}), above = node_at({0, 0, 2 * h});
  ASSERT_LT(std::max({edge, next, above}), static_cast<int>(grid.mesh.points.size()));
  const std::vector<SkinCorner> skin{{{edge, next, above}, {h, h}, Vec3(0, -1, 0)}};
  CellRegion region;
  region.nodes = {next};
  Descent descent(grid.mesh, graph, entities, 1, monitor);
  EXPECT_NEAR(descent.min_determinant(targets, region, skin), 1, 1e-9);
  grid.mesh.points[next][0] = -0.3 * h;
  EXPECT_LT(descent.min_determinant(targets, region, skin), 0);
  Energy energy;
  energy.eps = 0.3;
  descent.run(energy, targets, region, {}, skin, 100);
  EXPECT_GT(descent.min_determinant(targets, region, skin), 0);
  EXPECT_GT(grid.mesh.points[next][0], 0);
}

}  // namespace
}  // namespace polycube
