#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/hexahedron.h"
#include "core/report.h"

namespace polycube {
namespace {

// Two cells along x; the second is sheared, so it is the worse one.
HexMesh two_cells() {
  HexMesh mesh;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 3; ++i) mesh.points.emplace_back(i + (i == 2 && k == 1 ? 0.5 : 0.0), j, k);
  for (int i = 0; i < 2; ++i) mesh.hexes.push_back({i, i + 1, i + 4, i + 3, i + 6, i + 7, i + 10, i + 9});
  return mesh;
}

Association association_of_end() {
  Association a;
  a.patches = {{4}, {1, 2}};
  a.quads = {{2, 5, 11, 8}};
  a.quad_patch = {0};
  a.lost_edges = {3};
  return a;
}

TEST(Report, WorstCellsAscendAndNameTheirFaces) {
  const auto cells = worst_cells(two_cells(), association_of_end(), 5);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].hex, 1);
  EXPECT_LT(cells[0].scaled_jacobian, 1);
  EXPECT_EQ(cells[0].faces, std::vector<int>{4});
  EXPECT_DOUBLE_EQ(cells[1].scaled_jacobian, 1);
  EXPECT_TRUE(cells[1].faces.empty());
  EXPECT_TRUE(cells[1].centre.isApprox(Vec3(0.5, 0.5, 0.5)));
}

TEST(Report, CaptureCountsMergedFacesAsLost) {
  const CadCapture c = capture(association_of_end(), 8, {1, 2, 3}, 3);
  EXPECT_EQ(c.vertices_captured, 8);
  EXPECT_EQ(c.edges_captured, 2);
  EXPECT_EQ(c.faces_captured, 1);
  EXPECT_EQ(c.lost_faces, (std::vector<int>{1, 2}));
}

TEST(Report, WhatIsIgnoredIsNeitherCapturedNorLost) {
  Association a = association_of_end();
  a.patches = {{3, 4}, {1, 2}};
  a.ignored_edges = {2};
  a.ignored_vertices = {8};
  a.ignored_faces = {1, 2};
  const CadCapture c = capture(a, 8, {1, 2, 3}, 4);
  EXPECT_EQ(c.vertices_captured, 7);
  EXPECT_EQ(c.edges_captured, 1);
  EXPECT_EQ(c.faces_captured, 0);
  EXPECT_EQ(c.lost_faces, (std::vector<int>{3, 4}));
  EXPECT_EQ(c.ignored_faces, (std::vector<int>{1, 2}));
}

TEST(Report, JsonHoldsWhatThePromiseSays) {
  MeshReport report;
  report.version = "1.2.3";
  report.options.labels = {{3, 0}};
  report.stages = {{"tet", 1.5}, {"label", 0.5}};
  report.capture = capture(association_of_end(), 8, {1, 2, 3}, 3);
  report.shape.warpage = {0, 0.125, 0.25};
  report.loose_nodes = 3;
  report.warnings = {"a \"quoted\" line"};
  const auto json = nlohmann::json::parse(to_json(report));
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["options"]["labels"], "Face3=+X");
  EXPECT_EQ(json["options"].size(), option_table().size());
  EXPECT_DOUBLE_EQ(json["seconds"].get<double>(), 2);
  EXPECT_EQ(json["cad"]["edges"]["lost"][0], "Edge3");
  EXPECT_TRUE(json["cad"]["edges"]["ignored"].empty());
  // Every entry is one kind of entity: who reads it goes through them all.
  for (const auto& kind : json["cad"]) EXPECT_TRUE(kind["lost"].is_array());
  EXPECT_EQ(json["counts"]["loose_nodes"], 3);
  EXPECT_EQ(json["quality"]["histogram"].size(), 10u);
  EXPECT_DOUBLE_EQ(json["quality"]["warpage"]["max"].get<double>(), 0.25);
  EXPECT_EQ(json["warnings"][0], "a \"quoted\" line");
}

}  // namespace
}  // namespace polycube
