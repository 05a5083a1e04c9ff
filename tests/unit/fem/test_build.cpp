#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/quality.h"
#include "fem/fem.h"
#include "unit/fem/fixtures.h"

namespace polycube {
namespace {

FemMesh build(const Example& e, int order, int threads = 1) {
  return build_fem_mesh(e.model, e.mesh, e.association, {.order = order, .threads = threads}, Monitor());
}

const FemGroup* group(const FemMesh& mesh, CadRef entity) {
  for (const FemGroup& g : mesh.groups)
    if (g.entity == entity) return &g;
  return nullptr;
}

TEST(BuildFemMesh, BoxOfFirstOrder) {
  const Example e = box_example(3);
  const FemMesh mesh = build(e, 1);
  EXPECT_EQ(mesh.points.size(), 64u);
  EXPECT_EQ(mesh.quads.size(), 54u);
  EXPECT_EQ(mesh.segments.size(), 36u);
  EXPECT_EQ(mesh.groups.size(), 8u + 12u + 6u + 1u);
  EXPECT_EQ(mesh.hexes[0][8], -1);
  for (int f = 1; f <= 6; ++f) {
    const FemGroup* face = group(mesh, {2, f});
    ASSERT_NE(face, nullptr);
    EXPECT_EQ(face->nodes.size(), 16u);
    EXPECT_EQ(face->elements.size(), 9u);
  }
  for (int v = 1; v <= 8; ++v) {
    const FemGroup* vertex = group(mesh, {0, v});
    ASSERT_NE(vertex, nullptr);
    ASSERT_EQ(vertex->nodes.size(), 1u);
    EXPECT_TRUE(mesh.points[vertex->nodes[0]].isApprox(e.model.vertex(v)));
  }
  EXPECT_EQ(group(mesh, {3, 1})->elements.size(), 27u);
}

TEST(BuildFemMesh, BoxOfSecondOrderHasEveryNodeOnce) {
  const FemMesh mesh = build(box_example(2), 2);
  EXPECT_EQ(mesh.points.size(), 27u + 54u);  // 2x2x2 cells have 54 edges
  for (const auto& hex : mesh.hexes)
    for (int k = 0; k < 12; ++k) {
      const Vec3 middle = (mesh.points[hex[kHexEdges[k][0]]] + mesh.points[hex[kHexEdges[k][1]]]) / 2;
      EXPECT_LT((mesh.points[hex[8 + k]] - middle).norm(), 1e-12);
    }
  EXPECT_EQ(group(mesh, {2, 1})->nodes.size(), 9u + 12u);
  EXPECT_EQ(group(mesh, {1, 1})->nodes.size(), 5u);
  EXPECT_TRUE(mesh.straight_nodes.empty());
}

TEST(BuildFemMesh, SurfacesPointOut) {
  // Corners of Abaqus' faces S1 to S6, from its manual.
  constexpr std::array<std::array<int, 4>, 6> kFaces{{{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}}};
  const FemMesh mesh = build(box_example(2), 1);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
    const auto& hex = mesh.hexes[mesh.quad_hex[q][0]];
    std::array<int, 4> from_hex, from_quad;
    for (int k = 0; k < 4; ++k) {
      from_hex[k] = hex[kFaces[mesh.quad_hex[q][1]][k]];
      from_quad[k] = mesh.quads[q][k];
    }
    std::sort(from_hex.begin(), from_hex.end());
    std::sort(from_quad.begin(), from_quad.end());
    EXPECT_EQ(from_hex, from_quad);
  }
}

TEST(BuildFemMesh, MidNodesOfACylinderStandOnIt) {
  const Example e = cylinder_example();
  const FemMesh mesh = build(e, 2);
  EXPECT_TRUE(mesh.straight_nodes.empty());
  int curved = 0;
  for (const FemGroup& g : mesh.groups) {
    if (g.entity.dim != 2 || e.model.face(g.entity.id).kind != SurfaceKind::kCylinder) continue;
    EXPECT_EQ(g.elements.size(), 4u);
    EXPECT_EQ(g.nodes.size(), 8u + 12u);
    for (int p : g.nodes) {
      EXPECT_NEAR(std::hypot(mesh.points[p][0], mesh.points[p][1]), 1, 1e-9);
      ++curved;
    }
  }
  EXPECT_EQ(curved, 20);
  for (int h = 0; h < 5; ++h) EXPECT_GT(least_jacobian(mesh, h), 0);
}

TEST(BuildFemMesh, CompositePatchIsSplitByDistance) {
  Example e = box_example(2);
  // One patch of two faces that meet.
  Association& a = e.association;
  const auto shared = e.model.edge(1).faces;
  a.patches[shared[0] - 1] = {std::min(shared[0], shared[1]), std::max(shared[0], shared[1])};
  for (int& patch : a.quad_patch)
    if (patch == shared[1] - 1) patch = shared[0] - 1;
  const FemMesh mesh = build(e, 1);
  EXPECT_EQ(group(mesh, {2, shared[0]})->elements.size(), 4u);
  EXPECT_EQ(group(mesh, {2, shared[1]})->elements.size(), 4u);
}

TEST(BuildFemMesh, DoesNotDependOnThreads) {
  const Example e = cylinder_example();
  const FemMesh one = build(e, 2, 1), four = build(e, 2, 4);
  ASSERT_EQ(one.points.size(), four.points.size());
  for (std::size_t p = 0; p < one.points.size(); ++p) EXPECT_EQ(one.points[p], four.points[p]);
}

TEST(BuildFemMesh, RefusesACellThatIsBadInside) {
  Example e = box_example(1);
  std::swap(e.mesh.points[0], e.mesh.points[7]);
  try {
    build(e, 1);
    FAIL() << "an inverted cell got through";
  } catch (const StageFailed& failure) {
    EXPECT_EQ(failure.stage(), "fem");
    EXPECT_FALSE(failure.entities().empty());
  }
}

TEST(BuildFemMesh, CanBeCancelled) {
  Monitor monitor;
  monitor.cancel();
  const Example e = box_example(1);
  EXPECT_THROW(build_fem_mesh(e.model, e.mesh, e.association, {}, monitor), Cancelled);
}

// The Jacobian's integral over the reference cube is the volume: checks the shape functions through a curved cell's known one.
TEST(LeastJacobian, OfACubeIsAnEighthOfItsVolume) {
  for (int order : {1, 2}) {
    const FemMesh mesh = build(box_example(1), order);
    EXPECT_NEAR(least_jacobian(mesh, 0), 24.0 / 8, 1e-12);
  }
}

TEST(LeastJacobian, SeesAMidNodePushedThroughTheCell) {
  FemMesh mesh = build(box_example(1), 2);
  mesh.points[mesh.hexes[0][8]] += Vec3(0, 4, 0);
  EXPECT_LT(least_jacobian(mesh, 0), 0);
}

}  // namespace
}  // namespace polycube
