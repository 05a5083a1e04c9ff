#include <gtest/gtest.h>

#include <algorithm>

#include "fem/join.h"
#include "unit/fem/fixtures.h"

namespace polycube {
namespace {

FemMesh built(int n, int order) {
  const Example e = box_example(n);
  FemMesh mesh = build_fem_mesh(e.model, e.mesh, e.association, {.order = order, .threads = 1}, Monitor());
  mesh.hex_block.assign(mesh.hexes.size(), 0);
  return mesh;
}

const FemGroup& group(const FemMesh& mesh, const std::string& wanted) {
  const auto at = std::find_if(mesh.groups.begin(), mesh.groups.end(), [&](const FemGroup& g) { return group_name(g) == wanted; });
  EXPECT_NE(at, mesh.groups.end()) << wanted;
  return *at;
}

TEST(Join, EverySolidKeepsItsNodesCellsAndPlaces) {
  for (const int order : {1, 2}) {
    const std::vector<FemMesh> parts{built(1, order), built(2, order)};
    const FemMesh whole = join(parts, {1, 2}, {});
    ASSERT_EQ(whole.points.size(), parts[0].points.size() + parts[1].points.size());
    EXPECT_EQ(whole.corner_count, parts[0].corner_count + parts[1].corner_count);
    std::size_t at = 0, quad = 0;
    for (std::size_t s = 0; s < parts.size(); ++s) {
      for (const auto& hex : parts[s].hexes) {
        EXPECT_EQ(whole.hex_solid[at], static_cast<int>(s) + 1);
        EXPECT_EQ(whole.hex_block[at], static_cast<int>(s));
        for (std::size_t k = 0; k < hex.size(); ++k) {
          ASSERT_EQ(whole.hexes[at][k] < 0, hex[k] < 0);
          if (hex[k] >= 0) {
            EXPECT_EQ(whole.points[whole.hexes[at][k]], parts[s].points[hex[k]]);
          }
          EXPECT_EQ(k < 8, whole.hexes[at][k] >= 0 && whole.hexes[at][k] < whole.corner_count);
        }
        ++at;
      }
      for (std::size_t q = 0; q < parts[s].quads.size(); ++q, ++quad) EXPECT_EQ(whole.hex_solid[whole.quad_hex[quad][0]], static_cast<int>(s) + 1);
    }
    EXPECT_EQ(group(whole, "Solid1").elements.size(), 1u);
    EXPECT_EQ(group(whole, "Solid2").elements.size(), 8u);
    EXPECT_EQ(group(whole, "Solid2").nodes.size(), parts[1].points.size());
  }
}

TEST(Join, WhatSolidsShareIsInGroupsOfEach) {
  const FemMesh whole = join({built(1, 2), built(2, 2)}, {1, 2}, {{{1, 2}, {std::vector<int>{1}, std::vector<int>{1, 3}}, 0}});
  EXPECT_EQ(group(whole, "Face1").elements.size(), 1u + 4u);
  EXPECT_EQ(group(whole, "Solid1_Face1").elements.size(), 1u);
  EXPECT_EQ(group(whole, "Solid2_Face1").elements.size(), 4u);
  EXPECT_EQ(group(whole, "Solid1_Solid2").elements, group(whole, "Solid1_Face1").elements);
  EXPECT_EQ(group(whole, "Solid2_Solid1").elements.size(), 8u);
  for (const FemGroup& g : whole.groups) {
    EXPECT_TRUE(std::is_sorted(g.nodes.begin(), g.nodes.end())) << group_name(g);
    EXPECT_EQ(std::adjacent_find(g.nodes.begin(), g.nodes.end()), g.nodes.end()) << group_name(g);
  }
}

}  // namespace
}  // namespace polycube
