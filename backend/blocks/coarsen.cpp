#include "blocks/coarsen.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/union_find.h"

namespace polycube {

Coarse coarsen(const std::vector<Block>& fine, const std::vector<BlockPlanes>& planes, const std::vector<std::array<int, 3>>& touched,
               const std::vector<Chart>& charts, const std::array<std::vector<int>, 3>& chart_of_plane) {
  const int count = static_cast<int>(fine.size());
  // A face between two blocks has the number of the upper one's low side.
  const auto face = [&](int block, int side) {
    const int axis = side / 2;
    if (side % 2 == 0) return 3 * block + axis;
    const int n = fine[block].neighbours[side];
    return n >= 0 ? 3 * n + axis : 3 * (count + block) + axis;
  };
  UnionFind sheet_of(static_cast<std::size_t>(6 * count));
  for (int b = 0; b < count; ++b) {
    for (int lateral = 0; lateral < 6; ++lateral) {
      const int n = fine[b].neighbours[lateral];
      if (n < 0) continue;
      for (int side = 0; side < 6; ++side) {
        if (side / 2 != lateral / 2) sheet_of.unite(face(b, side), face(n, side));
      }
    }
  }
  std::vector<std::array<int, 2>> contact;  // sheet representative, chart
  for (int b = 0; b < count; ++b) {
    for (int side = 0; side < 6; ++side) {
      if (fine[b].neighbours[side] < 0 && fine[b].side_chart[side] >= 0) contact.push_back({sheet_of.find(face(b, side)), fine[b].side_chart[side]});
    }
  }
  std::vector<char> has_chart(static_cast<std::size_t>(6 * count), 0);
  for (const auto& [sheet, chart] : contact) has_chart[sheet] = 1;
  for (int b = 0; b < count; ++b) {
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, sheet = sheet_of.find(face(b, side));
      if (!has_chart[sheet] && !chart_of_plane[axis].empty()) contact.push_back({sheet, chart_of_plane[axis][planes[b][axis][side % 2]]});
    }
  }
  for (const auto& [block, side, feature] : touched) contact.push_back({sheet_of.find(face(block, side)), feature});
  std::sort(contact.begin(), contact.end());
  contact.erase(std::unique(contact.begin(), contact.end()), contact.end());

  Coarse coarse;
  std::vector<int> number(static_cast<std::size_t>(6 * count), -1);  // per representative of a kept sheet
  UnionFind same(charts.size());
  for (const auto& [sheet, chart] : contact) {
    if (number[sheet] < 0) {
      number[sheet] = static_cast<int>(coarse.sheets.size());
      coarse.sheets.push_back({charts[chart].axis, -1, {}});
    }
    auto& members = coarse.sheets[number[sheet]].charts;
    members.push_back(chart);
    same.unite(members.front(), chart);
  }
  coarse.unknown.assign(charts.size(), -1);
  for (Sheet& sheet : coarse.sheets) {
    sheet.unknown = same.find(sheet.charts.front());
    for (int c : sheet.charts) coarse.unknown[c] = sheet.unknown;
  }

  UnionFind merged(fine.size());
  for (int b = 0; b < count; ++b) {
    for (int axis = 0; axis < 3; ++axis) {
      const int below = fine[b].neighbours[low_side(axis)];
      if (below >= 0 && number[sheet_of.find(face(b, 2 * axis))] < 0) merged.unite(below, b);
    }
  }
  coarse.block_of.assign(fine.size(), -1);
  std::vector<double> box_volume;
  for (int b = 0; b < count; ++b) {
    const int root = merged.find(b);
    if (root == b) {
      coarse.block_of[b] = static_cast<int>(coarse.blocks.size());
      Block block;
      block.neighbours.fill(-1);
      block.side_chart.fill(-1);
      coarse.blocks.push_back(block);
      coarse.planes.push_back(planes[b]);
    }
    const int k = coarse.block_of[b] = coarse.block_of[root];
    coarse.blocks[k].volume += fine[b].volume;
    for (int d = 0; d < 3; ++d) {
      coarse.planes[k][d][0] = std::min(coarse.planes[k][d][0], planes[b][d][0]);
      coarse.planes[k][d][1] = std::max(coarse.planes[k][d][1], planes[b][d][1]);
    }
  }
  // Every side of a merged block lies on one sheet.
  std::vector<std::array<char, 6>> known(coarse.blocks.size(), std::array<char, 6>{});
  for (int b = 0; b < count; ++b) {
    const int k = coarse.block_of[b];
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2, sheet = number[sheet_of.find(face(b, side))];
      if (sheet < 0) continue;
      Block& block = coarse.blocks[k];
      const int n = fine[b].neighbours[side] < 0 ? -1 : coarse.block_of[fine[b].neighbours[side]];
      const bool outer = planes[b][axis][side % 2] == coarse.planes[k][axis][side % 2];
      if (!outer || n == k || (known[k][side] && (block.sheets[axis][side % 2] != sheet || block.neighbours[side] != n))) {
        throw StageFailed("blocks", "blocks between the charts' planes are not boxes");
      }
      known[k][side] = 1;
      block.sheets[axis][side % 2] = sheet;
      block.charts[axis][side % 2] = coarse.sheets[sheet].unknown;
      block.neighbours[side] = n;
      if (n < 0) block.side_chart[side] = fine[b].side_chart[side];
    }
  }
  for (const auto& sides : known) {
    if (std::count(sides.begin(), sides.end(), 0) > 0) throw StageFailed("blocks", "a block has a side on no chart's sheet");
  }
  return coarse;
}

}  // namespace polycube
