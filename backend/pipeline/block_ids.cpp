#include "pipeline/block_ids.h"

#include <algorithm>

#include "core/hexahedron.h"

namespace polycube {

std::vector<int> carry_blocks(const HexMesh& mesh, std::vector<int> blocks, const std::set<Quad>& walls) {
  struct Side {
    Quad face;
    int hex;
  };
  std::vector<Side> sides;
  sides.reserve(6 * mesh.hexes.size());
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h) {
    for (const auto& f : kHexFaces) {
      Side side{{mesh.hexes[h][f[0]], mesh.hexes[h][f[1]], mesh.hexes[h][f[2]], mesh.hexes[h][f[3]]}, h};
      std::sort(side.face.begin(), side.face.end());
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.face != b.face ? a.face < b.face : a.hex < b.hex; });
  std::vector<std::array<int, 2>> adjoining;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].face == sides[i + 1].face && !walls.contains(sides[i].face)) adjoining.push_back({sides[i].hex, sides[i + 1].hex});
  }
  blocks.resize(mesh.hexes.size(), -1);
  for (bool changed = true; changed;) {
    // A layer of cells at a time; of several neighbours the lowest block.
    std::vector<int> next = blocks;
    for (const auto& [a, b] : adjoining) {
      for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
        if (blocks[from] < 0 || blocks[to] >= 0) continue;
        next[to] = next[to] < 0 ? blocks[from] : std::min(next[to], blocks[from]);
      }
    }
    changed = next != blocks;
    blocks = std::move(next);
  }
  return blocks;
}

}  // namespace polycube
