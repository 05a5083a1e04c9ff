#include "hex/connectivity.h"

#include <algorithm>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/options.h"
#include "core/union_find.h"

namespace polycube {
namespace {

/// Lattice of a block: (n + 1) points along each axis; a block of no extent has one layer and glues its two sides.
class Lattice {
 public:
  Lattice(const BlockComplex& complex, const std::vector<int>& value) : extent_(complex.blocks.size()), first_(complex.blocks.size() + 1, 0) {
    double cells = 0;
    for (std::size_t b = 0; b < complex.blocks.size(); ++b) {
      for (int d = 0; d < 3; ++d) {
        const auto [low, high] = complex.blocks[b].charts[d];
        extent_[b][d] = value[high] - value[low];
        if (extent_[b][d] < 0) throw StageFailed("hex", "the integers of the charts are not in the order of the map");
      }
      cells += 1.0 * std::max(extent_[b][0], 1) * std::max(extent_[b][1], 1) * std::max(extent_[b][2], 1);
      check_count(cells);
      first_[b + 1] = first_[b] + (extent_[b][0] + 1) * (extent_[b][1] + 1) * (extent_[b][2] + 1);
    }
  }
  const std::array<int, 3>& extent(int block) const { return extent_[block]; }
  bool solid(int block) const { return extent_[block][0] > 0 && extent_[block][1] > 0 && extent_[block][2] > 0; }
  int size() const { return first_.back(); }
  int first(int block) const { return first_[block]; }
  int point(int block, const std::array<int, 3>& at) const {
    return first_[block] + (at[0] * (extent_[block][1] + 1) + at[1]) * (extent_[block][2] + 1) + at[2];
  }

 private:
  std::vector<std::array<int, 3>> extent_;
  std::vector<int> first_;
};

/// Calls visit(at) for all integer points of [0, last].
template <class Visit>
void for_box(const std::array<int, 3>& last, const Visit& visit) {
  for (int i = 0; i <= last[0]; ++i) {
    for (int j = 0; j <= last[1]; ++j) {
      for (int k = 0; k <= last[2]; ++k) visit(std::array{i, j, k});
    }
  }
}

std::vector<int> merge(const BlockComplex& complex, const Lattice& lattice) {
  UnionFind same(static_cast<std::size_t>(lattice.size()));
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    for (int d = 0; d < 3; ++d) {
      const int n = complex.blocks[b].neighbours[2 * d + 1];
      if (n < 0) continue;
      auto last = lattice.extent(b);
      last[d] = 0;
      for_box(last, [&](std::array<int, 3> at) {
        at[d] = lattice.extent(b)[d];
        const int here = lattice.point(b, at);
        at[d] = 0;
        same.unite(here, lattice.point(n, at));
      });
    }
  }
  std::vector<int> root(static_cast<std::size_t>(lattice.size()));
  for (int i = 0; i < lattice.size(); ++i) root[i] = same.find(i);
  return root;
}

}  // namespace

Connectivity connect(const PolycuboidMap& map, const BlockComplex& complex, const std::vector<int>& value, const Spacing& spacing) {
  const Lattice lattice(complex, value);
  const std::vector<int> root = merge(complex, lattice);
  Connectivity result;
  HexComplex& hexes = result.hexes;
  const int block_count = static_cast<int>(complex.blocks.size());

  std::vector<int> node(root.size(), -1);  // per root
  int nodes = 0;
  const auto node_at = [&](int block, const std::array<int, 3>& at) {
    int& n = node[root[lattice.point(block, at)]];
    if (n < 0) n = nodes++;
    return n;
  };
  for (int b = 0; b < block_count; ++b) {
    if (!lattice.solid(b)) continue;
    const auto& extent = lattice.extent(b);
    for_box({extent[0] - 1, extent[1] - 1, extent[2] - 1}, [&](const std::array<int, 3>& at) {
      Hex hex;
      for (int c = 0; c < 8; ++c) {
        const auto& k = kCornerCoordinates[c];
        hex[c] = node_at(b, {at[0] + k[0], at[1] + k[1], at[2] + k[2]});
      }
      hexes.mesh.hexes.push_back(hex);
      hexes.hex_block.push_back(b);
    });
  }
  for (int b = 0; b < block_count; ++b) {
    if (!lattice.solid(b)) continue;
    for (int side = 0; side < 6; ++side) {
      // Blocks squashed along this axis have the same side again behind them.
      const int d = side / 2;
      int last = b, next = complex.blocks[b].neighbours[side];
      while (next >= 0 && lattice.extent(next)[d] == 0) {
        last = next;
        next = complex.blocks[last].neighbours[side];
      }
      if (next >= 0) continue;
      auto cells = lattice.extent(b);
      for (int& n : cells) --n;
      cells[d] = 0;
      for_box(cells, [&](std::array<int, 3> at) {
        if (side % 2 == 1) at[d] = lattice.extent(b)[d] - 1;
        Quad quad;
        for (int k = 0; k < 4; ++k) {
          const auto& corner = kCornerCoordinates[kHexFaces[side][k]];
          quad[k] = node_at(b, {at[0] + corner[0], at[1] + corner[1], at[2] + corner[2]});
        }
        hexes.quads.push_back(quad);
        hexes.quad_chart.push_back(complex.blocks[last].side_chart[side]);
        result.quad_block.push_back(last);
      });
    }
  }
  hexes.mesh.points.assign(nodes, Vec3::Zero());
  hexes.param.assign(nodes, Vec3::Zero());

  // Every lattice point that a node merges is a place in the image where the node may stand, and may lie on features.
  struct Member {
    int node, block;
    std::array<int, 3> at;
  };
  std::vector<Member> members;
  std::vector<std::array<int, 2>> node_feature;
  for (int b = 0; b < block_count; ++b) {
    const Block& block = complex.blocks[b];
    for_box(lattice.extent(b), [&](const std::array<int, 3>& at) {
      const int n = node[root[lattice.point(b, at)]];
      if (n < 0) return;
      members.push_back({n, b, at});
      for (int d = 0; d < 3; ++d) {
        for (int s : {0, 1}) {
          if (at[d] != (s == 0 ? 0 : lattice.extent(b)[d])) continue;
          for (int c : complex.sheets[block.sheets[d][s]].charts) {
            if (map.charts[c].sign == 0) node_feature.push_back({n, c});
          }
        }
      }
    });
  }
  std::sort(node_feature.begin(), node_feature.end());
  node_feature.erase(std::unique(node_feature.begin(), node_feature.end()), node_feature.end());
  hexes.node_feature_first.assign(nodes + 1, 0);
  for (const auto& [n, c] : node_feature) {
    ++hexes.node_feature_first[n + 1];
    hexes.node_features.push_back(c);
  }
  result.place_first.assign(nodes + 1, 0);
  for (const Member& m : members) ++result.place_first[m.node + 1];
  for (int n = 0; n < nodes; ++n) {
    hexes.node_feature_first[n + 1] += hexes.node_feature_first[n];
    result.place_first[n + 1] += result.place_first[n];
  }
  result.places.resize(members.size());
  auto fill = result.place_first;
  for (const Member& m : members) {
    NodePlace place{m.block, Vec3::Zero(), Vec3::Zero()};
    for (int d = 0; d < 3; ++d) {
      const auto [low_chart, high_chart] = complex.blocks[m.block].charts[d];
      const double low = map.charts[low_chart].value, high = map.charts[high_chart].value;
      const int n = lattice.extent(m.block)[d];
      if (n == 0) {
        place.low[d] = low;
        place.high[d] = high;
      } else {
        const std::vector<double>* places = spacing.places.empty() ? nullptr : &spacing.places[spacing.layers.of[m.block][d]];
        const double t = places && !places->empty() ? (*places)[m.at[d]] : static_cast<double>(m.at[d]) / n;
        place.low[d] = place.high[d] = m.at[d] == n ? high : low + t * (high - low);
      }
    }
    result.places[fill[m.node]++] = place;
  }
  return result;
}

std::vector<int> coarse_cells(const BlockComplex& complex, const std::vector<int>& coarse, const std::vector<int>& value) {
  const Lattice cells(complex, coarse), parts(complex, value);
  std::vector<int> result;
  int first = 0;  // cell of the block
  for (int b = 0; b < static_cast<int>(complex.blocks.size()); ++b) {
    if (!parts.solid(b)) continue;
    const auto &n = cells.extent(b), &m = parts.extent(b);
    if (!cells.solid(b)) throw InvalidInput("the integers do not keep the structure of the coarser ones");
    for_box({m[0] - 1, m[1] - 1, m[2] - 1}, [&](const std::array<int, 3>& at) {
      std::array<int, 3> cell;
      for (int d = 0; d < 3; ++d) cell[d] = at[d] * n[d] / m[d];
      result.push_back(first + (cell[0] * n[1] + cell[1]) * n[2] + cell[2]);
    });
    first += n[0] * n[1] * n[2];
  }
  return result;
}

}  // namespace polycube
