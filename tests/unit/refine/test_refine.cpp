#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/quality.h"
#include "pad/pad.h"
#include "pad/topology.h"
#include "refine/refine.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

int count(const std::vector<char>& cells) { return static_cast<int>(std::count(cells.begin(), cells.end(), 1)); }

double volume(const HexMesh& mesh) {
  double sum = 0;
  for (const Hex& h : mesh.hexes) sum += hex_volume(mesh.points, h);
  return sum;
}

RefinedMesh refined(const Grid& grid, const CadRef& entity, int levels = 1) {
  RefinedMesh result{grid.mesh, grid.association, {}, 0};
  for (int level = 0; level < levels; ++level) {
    RefinedMesh next = refine_cells(result.mesh, result.association, {cells_at(result.mesh, result.association, entity), {}}, Monitor());
    result = std::move(next);
  }
  return result;
}

/// What holds of every refinement.
void expect_sound(const HexMesh& before, const RefinedMesh& after, double least = 0.2) {
  EXPECT_EQ(check(after.mesh, after.association), std::vector<std::string>{});
  const QualitySummary quality = summarise(after.mesh);
  EXPECT_EQ(quality.inverted, 0);
  EXPECT_GT(quality.min_scaled_jacobian, least);
  EXPECT_NEAR(volume(after.mesh), volume(before), 1e-9 * volume(before));
  EXPECT_TRUE(std::equal(before.points.begin(), before.points.end(), after.mesh.points.begin()));
  EXPECT_GE(after.grown, 0);
  EXPECT_TRUE(std::is_sorted(after.parent.begin(), after.parent.end()));
  EXPECT_EQ(after.parent.size(), after.mesh.hexes.size());
}

std::map<int, int> quads_on_faces(const Association& a) {
  std::map<int, int> result;
  for (const int p : a.quad_patch) ++result[a.patches[p].front()];
  return result;
}

TEST(RefineCells, AtEveryEntityOfABox) {
  const Grid grid = box_grid(3);
  for (int dim = 0; dim < 4; ++dim) {
    for (int id = 1; id <= std::array{8, 12, 6, 1}[static_cast<std::size_t>(dim)]; ++id) {
      const RefinedMesh result = refined(grid, {dim, id});
      expect_sound(grid.mesh, result);
      EXPECT_GT(result.mesh.hexes.size(), grid.mesh.hexes.size());
    }
  }
  EXPECT_EQ(refined(grid, {3, 1}).mesh.hexes.size(), 27 * grid.mesh.hexes.size());
}

TEST(RefineCells, StaysLocal) {
  const Grid grid = box_grid(5);  // 15 x 10 x 5 cells
  const RefinedMesh one = refined(grid, {0, 1});
  // A corner's cell, three beside it by a face, three by an edge.
  EXPECT_EQ(one.mesh.hexes.size(), grid.mesh.hexes.size() - 7 + 27 + 3 * 13 + 3 * 5);
  std::vector<int> parts(grid.mesh.hexes.size(), 0);
  for (const int p : one.parent) ++parts[p];
  EXPECT_EQ(std::count(parts.begin(), parts.end(), 1), static_cast<long>(grid.mesh.hexes.size()) - 7);
  expect_sound(grid.mesh, refined(grid, {0, 1}, 3), 0.05);
}

TEST(RefineCells, CarriesTheAssociation) {
  const Grid grid = box_grid(3);
  const CadModel model = CadModel::from_brep(grid.brep);
  const int edge = 1;
  const RefinedMesh result = refined(grid, {1, edge});
  const auto segments = [&](const Association& a) { return std::count(a.segment_edge.begin(), a.segment_edge.end(), edge); };
  EXPECT_EQ(segments(result.association), 3 * segments(grid.association));
  for (std::size_t v = 0; v < result.mesh.points.size(); ++v) {
    const CadRef cad = result.association.point_cad[v];
    const Vec3& p = result.mesh.points[v];
    if (cad.dim == 0) {
      EXPECT_LT((model.vertex(cad.id) - p).norm(), 1e-9);
    } else if (cad.dim == 1) {
      EXPECT_LT(model.project_to_edge(cad.id, p).distance, 1e-9);
    } else if (cad.dim == 2) {
      EXPECT_LT(model.project_to_face(result.association.patches[cad.id].front(), p).distance, 1e-9);
    }
  }
}

TEST(RefineCells, OfAFaceHasNineQuadsForEach) {
  const Grid grid = plate_grid(4);
  for (const auto& [face, quads] : quads_on_faces(grid.association)) {
    const RefinedMesh result = refined(grid, {2, face});
    expect_sound(grid.mesh, result, 0.1);
    EXPECT_EQ(quads_on_faces(result.association).at(face), 9 * quads);
  }
}

// As between two solids: the quads of a plane through the box, each as the cell below sees it.
TEST(RefineCells, QuadsBetweenCells) {
  Grid grid = box_grid(3);  // 9 x 6 x 3 cells
  const int patch = static_cast<int>(grid.association.patches.size());
  grid.association.patches.push_back({99});
  for (const Hex& hex : grid.mesh.hexes) {
    const auto& c = kHexFaces[5];
    const Quad quad{hex[c[0]], hex[c[1]], hex[c[2]], hex[c[3]]};
    if (std::abs(grid.mesh.points[quad[0]][2] - 1.0 / 3) > 1e-9) continue;
    grid.association.quads.push_back(quad);
    grid.association.quad_patch.push_back(patch);
  }
  ASSERT_EQ(quads_on_faces(grid.association).at(99), 54);
  const RefinedMesh result = refine_cells(grid.mesh, grid.association, {cells_at(grid.mesh, grid.association, {2, 99}), {}}, Monitor());
  EXPECT_EQ(quads_on_faces(result.association).at(99), 9 * 54);
  EXPECT_EQ(result.mesh.hexes.size(), (27 * 2 + 13) * 54U);
  const RefinedMesh corner = refined({"", grid.mesh, grid.association}, {0, 1}, 2);
  const HexTopology topology = build_topology(corner.mesh, corner.association.quads);
  double area = 0;
  for (std::size_t q = 0; q < corner.association.quads.size(); ++q) {
    if (corner.association.quad_patch[q] != patch) continue;
    const Quad& quad = corner.association.quads[q];
    EXPECT_EQ(sides_at(corner.mesh, topology, quad).size(), 2U);
    const std::vector<Vec3>& p = corner.mesh.points;
    const Vec3 twice = (p[quad[2]] - p[quad[0]]).cross(p[quad[3]] - p[quad[1]]);
    EXPECT_GT(twice[2], 0);
    area += twice[2] / 2;
  }
  EXPECT_NEAR(area, 6, 1e-9);
}

TEST(RefineCells, GrowsToWhereThereAreTemplates) {
  const Grid grid = l_grid(3);
  // Both faces of the inner corner: the cell between them has two marked faces.
  std::vector<char> cells(grid.mesh.hexes.size(), 0);
  for (std::size_t h = 0; h < grid.mesh.hexes.size(); ++h) {
    Vec3 centre = Vec3::Zero();
    for (const int n : grid.mesh.hexes[h]) centre += grid.mesh.points[n] / 8;
    const int i = static_cast<int>(centre[0] * 3), j = static_cast<int>(centre[1] * 3);
    cells[h] = (i == 2 && j > 2) || (j == 2 && i > 2);
  }
  const RefinedMesh result = refine_cells(grid.mesh, grid.association, {cells, {}}, Monitor());
  expect_sound(grid.mesh, result);
  EXPECT_EQ(result.grown, 3);  // one a layer
}

TEST(RefineCells, OnlyInTheSheetsAskedFor) {
  const Grid grid = plate_grid(4);
  const CadModel model = CadModel::from_brep(grid.brep);
  int bore = 0;
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).kind == SurfaceKind::kCylinder) bore = f;
  }
  std::vector<Segment> along;
  for (std::size_t s = 0; s < grid.association.segments.size(); ++s) {
    if (model.edge(grid.association.segment_edge[s]).closed) along.push_back(grid.association.segments[s]);
  }
  ASSERT_FALSE(along.empty());
  const RefinedMesh result = refine_cells(grid.mesh, grid.association, {cells_at(grid.mesh, grid.association, {2, bore}), along}, Monitor());
  expect_sound(grid.mesh, result, 0.1);
  // Three times as many round it, as many along it.
  EXPECT_EQ(quads_on_faces(result.association).at(bore), 3 * quads_on_faces(grid.association).at(bore));
}

TEST(RefineCells, NeighboursAreThoseThatShareANode) {
  const Grid grid = box_grid(5);
  const std::vector<char> corner = cells_at(grid.mesh, grid.association, {0, 1});
  EXPECT_EQ(count(corner), 1);
  EXPECT_EQ(count(with_neighbours(grid.mesh, corner)), 8);
  EXPECT_EQ(count(cells_at(grid.mesh, grid.association, {0, 99})), 0);
}

TEST(RefineCells, NothingMarkedNothingChanged) {
  const Grid grid = box_grid(2);
  const RefinedMesh result = refine_cells(grid.mesh, grid.association, {std::vector<char>(grid.mesh.hexes.size(), 0), {}}, Monitor());
  EXPECT_EQ(result.mesh.hexes, grid.mesh.hexes);
  EXPECT_EQ(result.association.quads, grid.association.quads);
  EXPECT_EQ(result.association.segments, grid.association.segments);
}

TEST(RefineCells, CanBeCancelled) {
  const Grid grid = box_grid(2);
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(refine_cells(grid.mesh, grid.association, {std::vector<char>(grid.mesh.hexes.size(), 1), {}}, monitor), Cancelled);
}

}  // namespace
}  // namespace polycube
