#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/hexahedron.h"
#include "core/quality.h"
#include "refine/templates.h"

namespace polycube {
namespace {

constexpr std::array<bool, 3> kEverywhere{true, true, true};

std::vector<Vec3> corners_of(const CellPart& part) {
  std::vector<Vec3> points;
  for (const CellPlace& place : part) points.emplace_back(place[0], place[1], place[2]);
  return points;
}

CornerSet set_of(std::initializer_list<int> corners) {
  CornerSet set = 0;
  for (const int c : corners) set = static_cast<CornerSet>(set | (1 << c));
  return set;
}

std::vector<CornerSet> all_sets() {
  std::vector<CornerSet> sets;
  for (int set = 0; set < 256; ++set) sets.push_back(static_cast<CornerSet>(set));
  return sets;
}

/// Facets of the parts that one part alone has, as sorted corners.
std::set<std::array<CellPlace, 4>> outer_facets(const std::vector<CellPart>& parts) {
  std::map<std::array<CellPlace, 4>, int> count;
  for (const CellPart& part : parts) {
    for (const auto& face : kHexFaces) {
      std::array<CellPlace, 4> key;
      for (int k = 0; k < 4; ++k) key[k] = part[face[k]];
      std::sort(key.begin(), key.end());
      ++count[key];
    }
  }
  std::set<std::array<CellPlace, 4>> outer;
  for (const auto& [key, n] : count) {
    EXPECT_LE(n, 2);
    if (n == 1) outer.insert(key);
  }
  return outer;
}

TEST(Templates, EverySetGrowsToOneThatStays) {
  for (const CornerSet set : all_sets()) {
    const CornerSet grown = with_template(set);
    EXPECT_EQ(grown & set, set);
    EXPECT_EQ(with_template(grown), grown);
  }
  EXPECT_EQ(with_template(set_of({3})), set_of({3}));
  EXPECT_EQ(with_template(set_of({0, 2})), set_of({0, 2}));  // no edge between them
  EXPECT_EQ(with_template(set_of({0, 1, 3})), set_of({0, 1, 2, 3}));
  EXPECT_EQ(with_template(set_of({0, 1, 2, 3, 4})), 0xFF);
  EXPECT_EQ(with_template(set_of({0, 1, 6, 7})), 0xFF);
}

TEST(Templates, HaveSoManyParts) {
  EXPECT_EQ(cell_parts(set_of({5}), kEverywhere).size(), 1u);
  EXPECT_EQ(cell_parts(set_of({2, 6}), kEverywhere).size(), 5u);
  EXPECT_EQ(cell_parts(set_of({1, 2, 5, 6}), kEverywhere).size(), 13u);
  EXPECT_EQ(cell_parts(0xFF, kEverywhere).size(), 27u);
  EXPECT_EQ(cell_parts(0xFF, {true, false, true}).size(), 9u);
  EXPECT_EQ(cell_parts(0xFF, {false, false, true}).size(), 3u);
  EXPECT_EQ(cell_parts(set_of({1, 2, 5, 6}), {true, true, false}).size(), 4u);
  EXPECT_EQ(cell_parts(set_of({1, 2, 5, 6}), {true, false, false}).size(), 1u);
  EXPECT_EQ(cell_parts(set_of({2, 6}), {true, true, false}).size(), 1u);
}

// Whatever is marked, and along whichever directions edges are divided: good cells that fill the cell and have common facets inside.
TEST(Templates, FillTheCellWithGoodParts) {
  int looked_at = 0;
  for (const CornerSet set : all_sets()) {
    if (with_template(set) != set) continue;
    for (int flags = 0; flags < 8; ++flags) {
      const std::vector<CellPart> parts = cell_parts(set, {(flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0});
      double volume = 0;
      for (const CellPart& part : parts) {
        const std::vector<Vec3> points = corners_of(part);
        const Hex hex{0, 1, 2, 3, 4, 5, 6, 7};
        EXPECT_GT(scaled_jacobian(points, hex), 0.4) << int(set);
        volume += hex_volume(points, hex);
      }
      EXPECT_NEAR(volume, 27, 1e-9) << int(set);
      for (const auto& facet : outer_facets(parts)) {
        bool on_side = false;
        for (int a = 0; a < 3; ++a) {
          for (const int level : {0, 3}) on_side |= std::all_of(facet.begin(), facet.end(), [&](const CellPlace& p) { return p[a] == level; });
        }
        EXPECT_TRUE(on_side) << int(set);
      }
      ++looked_at;
    }
  }
  EXPECT_GT(looked_at, 300);
}

// Two cells that share the side +u / -u, whatever else is marked of them, divide it alike.
TEST(Templates, OfNeighboursFitTogether) {
  std::map<std::pair<int, int>, std::set<std::array<std::array<int, 2>, 4>>> seen;  // by marks on the side and directions in it
  const auto side_facets = [](const std::vector<CellPart>& parts, int level) {
    std::set<std::array<std::array<int, 2>, 4>> facets;
    for (const auto& facet : outer_facets(parts)) {
      if (!std::all_of(facet.begin(), facet.end(), [&](const CellPlace& p) { return p[0] == level; })) continue;
      std::array<std::array<int, 2>, 4> flat;
      for (int k = 0; k < 4; ++k) flat[k] = {facet[k][1], facet[k][2]};
      facets.insert(flat);
    }
    return facets;
  };
  for (const CornerSet set : all_sets()) {
    if (with_template(set) != set) continue;
    for (int flags = 0; flags < 8; ++flags) {
      const std::vector<CellPart> parts = cell_parts(set, {(flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0});
      for (const int level : {0, 3}) {
        int marks = 0;
        for (int c = 0; c < 8; ++c) {
          const auto& x = kCornerCoordinates[c];
          if (3 * x[0] == level && ((set >> c) & 1)) marks |= 1 << (x[1] + 2 * x[2]);
        }
        const auto facets = side_facets(parts, level);
        const auto [at, fresh] = seen.try_emplace({marks, flags >> 1}, facets);
        EXPECT_EQ(at->second, facets) << int(set) << " side " << level;
      }
    }
  }
  EXPECT_GT(seen.size(), 20u);
}

}  // namespace
}  // namespace polycube
