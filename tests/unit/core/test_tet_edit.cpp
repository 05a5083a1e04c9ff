#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>

#include "core/charts.h"
#include "core/tet_edit.h"
#include "support/tet_grid.h"

namespace polycube {
namespace {

double volume(const TetMesh& m) {
  double sum = 0;
  for (const Tet& t : m.tets) {
    const double v = (m.points[t[1]] - m.points[t[0]]).cross(m.points[t[2]] - m.points[t[0]]).dot(m.points[t[3]] - m.points[t[0]]) / 6;
    EXPECT_GT(v, 0);
    sum += v;
  }
  return sum;
}

TEST(TetEditor, SplitsKeepTheMeshConformingAndClassified) {
  TetMesh mesh = tet_grid(2, 2, 2);
  mesh.segments = {{0, 1}};
  mesh.segment_edge = {7};
  const double before = volume(mesh);
  const std::size_t tets = mesh.tets.size(), triangles = mesh.triangles.size();
  TetEditor editor(mesh);
  const int on_edge = editor.split_edge(0, 1, (mesh.points[0] + mesh.points[1]) / 2);
  EXPECT_EQ(mesh.point_cad[on_edge], (CadRef{1, 7}));
  ASSERT_EQ(mesh.segments.size(), 2u);
  EXPECT_EQ(mesh.segment_edge[1], 7);
  EXPECT_EQ(mesh.triangles.size(), triangles + 2);
  EXPECT_GT(mesh.tets.size(), tets);
  // The same edge's half again, and an edge inside.
  editor.split_edge(0, on_edge, (mesh.points[0] + mesh.points[on_edge]) / 2);
  const int inside = editor.split_edge(0, 13, (mesh.points[0] + mesh.points[13]) / 2);
  EXPECT_EQ(mesh.point_cad[inside], (CadRef{3, 1}));
  EXPECT_NEAR(volume(mesh), before, 1e-12);
  for (const auto& n : triangle_neighbours(mesh.triangles)) {
    for (int t : n) EXPECT_GE(t, 0);
  }
  ASSERT_EQ(editor.triangle_parent().size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) EXPECT_EQ(mesh.triangle_face[t], mesh.triangle_face[editor.triangle_parent()[t]]);
}

TEST(TetEditor, TellsWhichPointsWouldInvert) {
  TetMesh mesh = tet_grid(2, 2, 2);
  const TetEditor editor(mesh);
  EXPECT_TRUE(editor.keeps_volumes(0, 13, (mesh.points[0] + mesh.points[13]) / 2));
  EXPECT_FALSE(editor.keeps_volumes(0, 13, mesh.points[13] + Vec3(5, 0, 0)));
}

TEST(TetEditor, MovesNodesAsFarAsTheTetsBear) {
  TetMesh mesh = tet_grid(2, 2, 2);
  TetEditor editor(mesh);
  const Vec3 before = mesh.points[13];
  EXPECT_FALSE(editor.move(13, before + Vec3(0.95, 0, 0)));
  EXPECT_EQ(mesh.points[13], before);
  EXPECT_TRUE(editor.move(13, before + Vec3(0.2, 0, 0)));
  EXPECT_EQ(mesh.points[13], Vec3(before + Vec3(0.2, 0, 0)));
  EXPECT_NEAR(volume(mesh), 8, 1e-12);
}

TEST(TetEditor, WhatIsBetweenSolidsIsSplitToo) {
  TetMesh mesh = tet_grid(2, 1, 1);
  const auto middle = [&](int node) { return mesh.points[node][0] == 1; };
  std::vector<int> between;
  for (const Tet& t : mesh.tets) {
    double x = 0;
    for (int n : t) x += mesh.points[n][0] / 4;
    mesh.tet_solid.push_back(x < 1 ? 0 : 1);
    for (int skip = 0; x < 1 && skip < 4; ++skip) {
      const Triangle facet{t[(skip + 1) % 4], t[(skip + 2) % 4], t[(skip + 3) % 4]};
      if (std::all_of(facet.begin(), facet.end(), middle)) mesh.inner_triangles.push_back(facet);
    }
  }
  ASSERT_EQ(mesh.inner_triangles.size(), 2u);
  mesh.inner_face = {5, 5};
  const Triangle first = mesh.inner_triangles[0];
  mesh.inner_segments = {{first[0], first[1]}};
  mesh.inner_segment_edge = {3};
  TetEditor editor(mesh);
  editor.split_edge(first[0], first[1], (mesh.points[first[0]] + mesh.points[first[1]]) / 2);
  EXPECT_EQ(mesh.tet_solid.size(), mesh.tets.size());
  EXPECT_EQ(mesh.inner_face, std::vector<int>(mesh.inner_triangles.size(), 5));
  EXPECT_EQ(mesh.inner_segment_edge, (std::vector<int>{3, 3}));
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double x = 0;
    for (int n : mesh.tets[t]) x += mesh.points[n][0] / 4;
    EXPECT_EQ(mesh.tet_solid[t], x < 1 ? 0 : 1);
  }
  // Every facet between the solids is listed.
  std::map<Triangle, std::set<int>> solids_at;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (int skip = 0; skip < 4; ++skip) {
      Triangle facet{mesh.tets[t][(skip + 1) % 4], mesh.tets[t][(skip + 2) % 4], mesh.tets[t][(skip + 3) % 4]};
      std::sort(facet.begin(), facet.end());
      solids_at[facet].insert(mesh.tet_solid[t]);
    }
  }
  std::size_t found = 0;
  for (const auto& [facet, solids] : solids_at) found += solids.size() == 2;
  EXPECT_EQ(found, mesh.inner_triangles.size());
}

}  // namespace
}  // namespace polycube
