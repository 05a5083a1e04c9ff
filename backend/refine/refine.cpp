#include "refine/refine.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/options.h"
#include "pad/topology.h"
#include "refine/region.h"
#include "refine/templates.h"

namespace polycube {
namespace {

/// A node by the corners of the cell, edge or face that it is in, ascending, and 27 times their weights; unused entries are {-1, 0}. So cells that share a face
/// have its nodes in common.
using NodeKey = std::array<std::array<int, 2>, 8>;

NodeKey key_of(const Hex& hex, const CellPlace& place) {
  NodeKey key;
  int count = 0;
  for (int c = 0; c < 8; ++c) {
    int weight = 1;
    for (int a = 0; a < 3; ++a) weight *= kCornerCoordinates[c][a] == 1 ? place[a] : 3 - place[a];
    if (weight > 0) key[count++] = {hex[c], weight};
  }
  std::sort(key.begin(), key.begin() + count);
  std::fill(key.begin() + count, key.end(), std::array{-1, 0});
  return key;
}

class Refining {
 public:
  Refining(const HexMesh& mesh, const Association& association, const RefineRegion& region, const Monitor& monitor)
      : mesh_(mesh), association_(association), monitor_(monitor), topology_(build_topology(mesh, association.quads)) {
    const std::vector<char> marked = marked_nodes(mesh, topology_, region.cells, monitor);
    const std::vector<std::array<bool, 3>> divided = divided_directions(mesh, region.along);
    double count = 0;
    corners_.reserve(mesh.hexes.size());
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
      corners_.push_back({marked_corners(mesh.hexes[h], marked), divided[h]});
      count += static_cast<double>(parts(h).size());
      if (corners_.back().first == kAllCorners && !region.cells[h]) ++made_.grown;
    }
    check_count(count);
  }

  RefinedMesh result() {
    made_.mesh.points = mesh_.points;
    made_.association = association_;
    made_.association.quads.clear();
    made_.association.quad_patch.clear();
    made_.association.segments.clear();
    made_.association.segment_edge.clear();
    std::vector<int> first(1, 0);  // per hex its first part
    for (std::size_t h = 0; h < mesh_.hexes.size(); ++h) {
      if (h % 10'000 == 0) monitor_.progress("refine", static_cast<double>(h) / static_cast<double>(mesh_.hexes.size()));
      for (const CellPart& part : parts(h)) {
        Hex hex;
        for (int c = 0; c < 8; ++c) hex[c] = node(mesh_.hexes[h], part[c]);
        made_.mesh.hexes.push_back(hex);
        made_.parent.push_back(static_cast<int>(h));
        places_.push_back(part);
      }
      first.push_back(static_cast<int>(made_.mesh.hexes.size()));
    }
    made_.association.point_cad.resize(made_.mesh.points.size(), CadRef{3, 1});
    divide_quads(first);
    divide_segments();
    return std::move(made_);
  }

 private:
  std::vector<CellPart> parts(std::size_t hex) const { return cell_parts(corners_[hex].first, corners_[hex].second); }

  int node(const Hex& hex, const CellPlace& place) {
    const NodeKey key = key_of(hex, place);
    if (key[1][0] < 0) return key[0][0];
    const auto [at, fresh] = nodes_.try_emplace(key, static_cast<int>(made_.mesh.points.size()));
    if (fresh) {
      Vec3 point = Vec3::Zero();
      for (const auto& [corner, weight] : key) {
        if (corner >= 0) point += weight / 27.0 * mesh_.points[corner];
      }
      made_.mesh.points.push_back(point);
    }
    return at->second;
  }

  /// The side of the cell that a quad looks away from; one between two cells is a side of both.
  int side_of(std::size_t q) const {
    if (topology_.quad_side[q] >= 0) return topology_.quad_side[q];
    Quad quad = association_.quads[q];
    std::rotate(quad.begin(), std::min_element(quad.begin(), quad.end()), quad.end());
    for (const int side : sides_at(mesh_, topology_, quad)) {
      Quad own;
      for (int k = 0; k < 4; ++k) own[k] = mesh_.hexes[side / 6][kHexFaces[side % 6][k]];
      std::rotate(own.begin(), std::min_element(own.begin(), own.end()), own.end());
      if (own == quad) return side;
    }
    throw StageFailed("refine", "a quad is no side of a cell");
  }

  // The sides of parts that lie in the side of the cell.
  void divide_quads(const std::vector<int>& first) {
    Association& a = made_.association;
    for (std::size_t q = 0; q < association_.quads.size(); ++q) {
      const int side = side_of(q), hex = side / 6, axis = side % 6 / 2, level = side % 2 == 0 ? 0 : 3;
      for (int part = first[hex]; part < first[hex + 1]; ++part) {
        for (const auto& corners : kHexFaces) {
          if (!std::all_of(corners.begin(), corners.end(), [&](int c) { return places_[part][c][axis] == level; })) continue;
          Quad quad;
          for (int k = 0; k < 4; ++k) quad[k] = made_.mesh.hexes[part][corners[k]];
          a.quads.push_back(quad);
          a.quad_patch.push_back(association_.quad_patch[q]);
          for (const int n : quad) {
            if (n >= static_cast<int>(mesh_.points.size())) a.point_cad[n] = {2, association_.quad_patch[q]};
          }
        }
      }
    }
  }

  void divide_segments() {
    Association& a = made_.association;
    for (std::size_t s = 0; s < association_.segments.size(); ++s) {
      const auto [from, to] = association_.segments[s];
      const auto third = [&](int near, int far) {
        NodeKey key;
        key.fill({-1, 0});
        key[0] = {near, 18};
        key[1] = {far, 9};
        if (near > far) std::swap(key[0], key[1]);
        const auto at = nodes_.find(key);
        return at == nodes_.end() ? -1 : at->second;
      };
      std::vector<int> chain{from, third(from, to), third(to, from), to};
      std::erase(chain, -1);
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        a.segments.push_back({chain[i], chain[i + 1]});
        a.segment_edge.push_back(association_.segment_edge[s]);
        if (i > 0) a.point_cad[chain[i]] = {1, association_.segment_edge[s]};
      }
    }
  }

  const HexMesh& mesh_;
  const Association& association_;
  const Monitor& monitor_;
  HexTopology topology_;
  std::vector<std::pair<CornerSet, std::array<bool, 3>>> corners_;  // per hex: marked corners, directions that are divided
  std::map<NodeKey, int> nodes_;
  std::vector<CellPart> places_;  // per hex made: its corners in the cell before
  RefinedMesh made_;
};

}  // namespace

RefinedMesh refine_cells(const HexMesh& mesh, const Association& association, const RefineRegion& region, const Monitor& monitor) {
  return Refining(mesh, association, region, monitor).result();
}

}  // namespace polycube
