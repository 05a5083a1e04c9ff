#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "fit/fit.h"
#include "pad/concentric.h"
#include "pad/divide.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

// Padded, with rings, and fitted.
struct Ringed {
  PaddedMesh padded;
  int rings = 0;
  FitReport fitted;
};

Ringed ringed(const Grid& grid, RingOptions options = {}) {
  const CadModel model = CadModel::from_brep(grid.brep);
  options.grid_cells = grid.mesh.hexes.size();
  Ringed result{pad(model, grid.mesh, grid.association, Monitor{}), 0, {}};
  result.rings = insert_concentric(model, result.padded, options, Monitor{});
  EXPECT_EQ(check(result.padded.mesh, result.padded.association), std::vector<std::string>{});
  result.fitted = fit(model, result.padded.mesh, result.padded.association, {}, Monitor{});
  EXPECT_EQ(result.fitted.inverted, 0);
  return result;
}

// Distances from the axis through `centre` along z of the nodes one, two, ... mesh edges from those at `radius`: least and most.
std::vector<std::pair<double, double>> rings_at(const HexMesh& mesh, const Vec2& centre, double radius, int count) {
  const auto distance = [&](int v) { return (mesh.points[v].head<2>() - centre).norm(); };
  std::vector<char> seen(mesh.points.size(), 0);
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) seen[v] = std::abs(distance(v) - radius) < 1e-6;
  std::vector<std::pair<double, double>> rings;
  for (int ring = 0; ring < count; ++ring) {
    std::set<int> next;
    for (const Hex& hex : mesh.hexes) {
      for (const auto& [c, d] : kHexEdges) {
        if (seen[hex[c]] != seen[hex[d]]) next.insert(seen[hex[c]] ? hex[d] : hex[c]);
      }
    }
    std::pair<double, double> range{1e9, 0};
    for (const int v : next) {
      range = {std::min(range.first, distance(v)), std::max(range.second, distance(v))};
      seen[v] = 1;
    }
    rings.push_back(range);
  }
  return rings;
}

// A tube of radii 1 and 1.5 and height 1 in a grid of a square in a square, n cells along the bore's side and n / 2 through the wall.
Grid tube_grid(int n, double outer = 1.5) {
  const gp_Ax2 axis(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(axis, outer, 1).Shape(), BRepPrimAPI_MakeCylinder(axis, 1, 1).Shape()).Shape();
  const int wall = n / 2, side = n + 2 * wall;
  return make_grid(
      shape, {side, side, 2}, [=](int i, int j, int) { return i < wall || i >= wall + n || j < wall || j >= wall + n; },
      [=](const Vec3& x) -> Vec3 {
        Vec2 p = 2.0 / n * (x.head<2>() - Vec2::Constant(side / 2.0));  // 1 on the bore, 2 outside
        const double longest = p.cwiseAbs().maxCoeff();
        p *= (1 + (longest - 1) * (outer - 1)) / p.norm();
        return {p[0], p[1], x[2] / 2};
      });
}

TEST(PadConcentric, LaysRingsRoundABore) {
  const Ringed plate = ringed(plate_grid(4));
  EXPECT_EQ(plate.rings, 1);
  const auto rings = rings_at(plate.padded.mesh, {2, 2}, 1, 2);
  for (const auto& [least, most] : rings) EXPECT_LT(most / least, 1.15);
  EXPECT_GT(rings[0].first, 1.1);
  EXPECT_GT((rings[1].first + rings[1].second) / 2, 1.35);
  EXPECT_GT(plate.fitted.min_scaled_jacobian, 0.7);
}

TEST(PadConcentric, TheSquareInACylinderSpansHalfOfIt) {
  for (const int n : {4, 8}) {
    const Grid grid = cylinder_grid(n);
    const Ringed shaft = ringed(grid);
    EXPECT_EQ(shaft.rings, 1);
    const int layers = std::max(2, (2 * n + 4) / 5);
    EXPECT_EQ(shaft.padded.mesh.hexes.size(), grid.mesh.hexes.size() + 4u * n * n * layers);
    const auto square = rings_at(shaft.padded.mesh, {0, 0}, 1, layers).back();
    EXPECT_GT(square.first, 0.4);
    EXPECT_LT(square.second, 0.7);
    EXPECT_NEAR((square.first + square.second) / 2, 0.55, 0.06);
  }
}

TEST(PadConcentric, ATubeIsNothingButRings) {
  const int n = 4;
  const Ringed tube = ringed(tube_grid(n));
  EXPECT_GE(tube.rings, 1);
  EXPECT_EQ(tube.padded.mesh.hexes.size(), 2u * 4 * n * (n / 2 + 1));
  for (const auto& [least, most] : rings_at(tube.padded.mesh, {0, 0}, 1, n / 2)) EXPECT_LT(most / least, 1.01);
  EXPECT_GT(tube.fitted.min_scaled_jacobian, 0.9);
  // Every cell comes from one of the grid, for its block.
  ASSERT_EQ(tube.padded.origin.size(), tube.padded.mesh.hexes.size());
  EXPECT_GE(*std::min_element(tube.padded.origin.begin(), tube.padded.origin.end()), 0);
}

TEST(PadConcentric, ATubeKeepsItsCellsWhereTheyAreCountedOrItIsThick) {
  EXPECT_EQ(ringed(tube_grid(4), {.radial = false}).rings, 0);
  EXPECT_TRUE(ringed(tube_grid(4, 1.75)).padded.origin.empty());
}

TEST(PadConcentric, ATubeKeepsItsCellsWhereTheyWouldGetTooLong) {
  const int n = 4;
  const double outside = 2 * std::numbers::pi * 1.6 / (4 * n);
  EXPECT_TRUE(ringed(tube_grid(n, 1.6), {.longest = 0.99 * outside}).padded.origin.empty());
  EXPECT_FALSE(ringed(tube_grid(n, 1.6), {.longest = 1.01 * outside}).padded.origin.empty());
}

TEST(PadConcentric, LaysRingsRoundAQuarterOfABore) {
  // A plate 2 x 2 x 1 with a quarter of a bore of radius 1 at its corner.
  const TopoDS_Shape bore = BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0, 0, -1), gp_Dir(0, 0, 1)), 1, 3).Shape();
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(2, 2, 1).Shape(), bore).Shape();
  const Ringed plate = ringed(make_grid(
      shape, {4, 4, 2}, [](int i, int j, int) { return i >= 2 || j >= 2; },
      [](const Vec3& x) -> Vec3 {
        Vec2 p = x.head<2>() / 2;
        const double longest = p.maxCoeff(), onto = std::clamp(2 - longest, 0.0, 1.0);
        if (longest > 0) p = (1 - onto) * p + onto * p * longest / p.norm();
        return {p[0], p[1], x[2] / 2};
      }));
  EXPECT_EQ(plate.rings, 1);
  for (const auto& [least, most] : rings_at(plate.padded.mesh, {0, 0}, 1, 2)) EXPECT_LT(most / least, 1.2);
}

TEST(PadConcentric, QuadsAcrossABoreAreCounted) {
  const Grid grid = tube_grid(4);
  const CadModel model = CadModel::from_brep(grid.brep);
  PaddedMesh padded = ringed(grid).padded;
  EXPECT_EQ(count_cut_offs(model, padded), 0);
  // A node of the bore goes to the other side: the quads about it cut the bore off.
  const auto at_bore = [&](int v) { return std::abs(padded.mesh.points[v].head<2>().norm() - 1) < 1e-6; };
  int moved = 0;
  while (!at_bore(moved)) ++moved;
  padded.mesh.points[moved].head<2>() *= -1;
  EXPECT_GT(count_cut_offs(model, padded), 0);
}

TEST(PadConcentric, LeavesABoreThatItIsToLeave) {
  const Grid plate = plate_grid(4);
  const CadModel model = CadModel::from_brep(plate.brep);
  RingOptions options;
  for (const int f : model.faces()) {
    if (model.face(f).kind == SurfaceKind::kCylinder) options.left_edges = {model.face(f).edges.front()};
  }
  EXPECT_EQ(ringed(plate, options).rings, 0);
}

TEST(PadConcentric, LeavesABoxAlone) { EXPECT_EQ(ringed(box_grid()).rings, 0); }

TEST(PadDivide, DividesALayerOfABoxAndTakesOneOut) {
  const Grid grid = box_grid(2);
  PaddedMesh padded{grid.mesh, grid.association};
  const auto first_sheet = [&] { return trace_sheet(padded.mesh, build_topology(padded.mesh, padded.association.quads), 0); };
  divide_sheet(padded, first_sheet(), 3);  // across x: 4 x 2 cells in a layer
  EXPECT_EQ(check(padded.mesh, padded.association), std::vector<std::string>{});
  EXPECT_EQ(padded.mesh.hexes.size(), grid.mesh.hexes.size() + 2u * 8);
  EXPECT_EQ(padded.association.segments.size(), grid.association.segments.size() + 2u * 4);
  std::vector<int> all(12);
  for (int e = 0; e < 12; ++e) all[e] = e + 1;
  EXPECT_FALSE(collapse_sheet(padded, first_sheet(), {}));  // it would take cells from edges
  EXPECT_TRUE(collapse_sheet(padded, first_sheet(), all));
  EXPECT_EQ(padded.mesh.hexes.size(), grid.mesh.hexes.size() + 8u);
  EXPECT_EQ(check(padded.mesh, padded.association), std::vector<std::string>{});
}

TEST(PadDivide, ASheetBetweenTwoVerticesStays) {
  const Grid grid = box_grid(1);
  PaddedMesh padded{grid.mesh, grid.association};
  std::vector<int> all(12);
  for (int e = 0; e < 12; ++e) all[e] = e + 1;
  const HexTopology topology = build_topology(padded.mesh, padded.association.quads);
  EXPECT_FALSE(collapse_sheet(padded, trace_sheet(padded.mesh, topology, 4), all));  // one cell from face to face
  EXPECT_EQ(padded.mesh.hexes, grid.mesh.hexes);
}

}  // namespace
}  // namespace polycube
