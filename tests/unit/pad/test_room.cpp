#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/quality.h"
#include "pad/pad.h"
#include "pad/room.h"
#include "support/grids.h"

namespace polycube {
namespace {

using namespace testing;

struct Bare {
  HexMesh mesh;
  std::vector<Quad> quads;
  std::vector<int> chart, triangle;

  explicit Bare(const Grid& grid) : mesh(grid.mesh), quads(grid.association.quads), chart(grid.association.quad_patch), triangle(quads.size()) {
    for (std::size_t q = 0; q < quads.size(); ++q) triangle[q] = static_cast<int>(q);
  }
  int room(int node, int quad) { return make_room(mesh, {quads, chart, triangle}, {node, quad}); }
  /// Charts of the quads at the node.
  std::multiset<int> charts_at(int node) const {
    std::multiset<int> charts;
    for (std::size_t q = 0; q < quads.size(); ++q) {
      if (std::find(quads[q].begin(), quads[q].end(), node) != quads[q].end()) charts.insert(chart[q]);
    }
    return charts;
  }
  std::vector<std::string> faults() const {
    Association a;
    a.patches = {{}};
    a.quads = quads;
    a.quad_patch.assign(quads.size(), 0);
    a.point_cad.assign(mesh.points.size(), {3, 1});
    for (const Quad& q : quads) {
      for (int n : q) a.point_cad[n] = {2, 0};
    }
    return check(mesh, a);
  }
};

// A corner of the box and a quad there.
std::pair<int, int> corner(const Grid& grid) {
  int node = 0;
  while (grid.association.point_cad[node].dim != 0) ++node;
  int quad = 0;
  while (std::find(grid.association.quads[quad].begin(), grid.association.quads[quad].end(), node) == grid.association.quads[quad].end()) ++quad;
  return {node, quad};
}

TEST(MakeRoom, DividesTheQuadAtACorner) {
  const Grid grid = box_grid(4);
  Bare bare(grid);
  const auto [node, quad] = corner(grid);
  const std::multiset<int> before = bare.charts_at(node);
  ASSERT_EQ(before.size(), 3u);
  const int hexes = static_cast<int>(bare.mesh.hexes.size()), added = bare.room(node, quad);
  EXPECT_EQ(added, 5 * 2 * 2);  // a block of eight, open on one side
  EXPECT_EQ(static_cast<int>(bare.mesh.hexes.size()), hexes + added);
  std::multiset<int> wanted = before;
  wanted.insert(bare.chart[quad]);
  EXPECT_EQ(bare.charts_at(node), wanted);
  EXPECT_EQ(bare.faults(), std::vector<std::string>{});
  EXPECT_EQ(summarise(bare.mesh).inverted, 0);
  EXPECT_EQ(bare.chart.size(), bare.quads.size());
  EXPECT_EQ(bare.triangle.size(), bare.quads.size());
}

TEST(MakeRoom, AgainAndAgainAtOneNode) {
  const Grid grid = box_grid(4);
  Bare bare(grid);
  const auto [node, quad] = corner(grid);
  for (std::size_t quads = 4; quads < 7; ++quads) {
    int at = 0;
    while (std::find(bare.quads[at].begin(), bare.quads[at].end(), node) == bare.quads[at].end()) ++at;
    EXPECT_GT(bare.room(node, at), 0);
    EXPECT_EQ(bare.charts_at(node).size(), quads);
    EXPECT_EQ(bare.faults(), std::vector<std::string>{});
  }
}

TEST(MakeRoom, InASingleLayerOfCells) {
  const Grid grid = box_grid(1);
  Bare bare(grid);
  const auto [node, quad] = corner(grid);
  EXPECT_GT(bare.room(node, quad), 0);
  EXPECT_EQ(bare.charts_at(node).size(), 4u);
  EXPECT_EQ(bare.faults(), std::vector<std::string>{});
}

// Corners found on one grid are served one after the other: a layer may move the quad of a later one off its node.
TEST(MakeRoom, EveryCornerFoundBeforeTheFirstLayer) {
  for (const int size : {1, 2, 3}) {
    const Grid grid = box_grid(size);
    Bare bare(grid);
    std::vector<CrowdedCorner> corners;
    for (std::size_t q = 0; q < bare.quads.size(); ++q) {
      for (int n : bare.quads[q]) {
        if (grid.association.point_cad[n].dim == 0) corners.push_back({n, static_cast<int>(q)});
      }
    }
    ASSERT_EQ(corners.size(), 24u);
    int layers = 0;
    for (const CrowdedCorner& c : corners) layers += bare.room(c.node, c.quad) > 0;
    EXPECT_GE(layers, 8) << size;
    if (size < 3) {
      EXPECT_LT(layers, 24) << size;  // some quads have moved
    }
    EXPECT_EQ(bare.faults(), std::vector<std::string>{}) << size;
  }
}

}  // namespace
}  // namespace polycube
