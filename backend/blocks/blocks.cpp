#include "blocks/blocks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "blocks/coarsen.h"
#include "blocks/pieces.h"
#include "core/error.h"
#include "core/hexahedron.h"
#include "core/union_find.h"

namespace polycube {
namespace {

[[noreturn]] void fail(const std::string& reason, std::vector<int> charts, const TetMesh& mesh, const PolycuboidMap& map) {
  std::sort(charts.begin(), charts.end());
  charts.erase(std::unique(charts.begin(), charts.end()), charts.end());
  std::string message = reason;
  std::vector<CadRef> entities;
  const char* separator = ": charts ";
  for (int c : charts) {
    message += separator + std::to_string(c);
    separator = ", ";
    for (int t : map.charts[c].triangles) {
      if (t < static_cast<int>(mesh.triangle_face.size())) entities.push_back({2, mesh.triangle_face[t]});
    }
  }
  std::sort(entities.begin(), entities.end());
  entities.erase(std::unique(entities.begin(), entities.end()), entities.end());
  throw StageFailed("blocks", message, entities);
}

void validate(const TetMesh& mesh, const PolycuboidMap& map) {
  if (mesh.tets.empty()) throw InvalidInput("the mesh has no tetrahedra");
  if (map.image.size() != mesh.points.size()) throw InvalidInput("the map does not have one image per point of the mesh");
  std::vector<char> seen(mesh.triangles.size(), 0);
  for (const Chart& chart : map.charts) {
    if (chart.axis < 0 || chart.axis > 2) throw InvalidInput("a chart has no axis");
    for (int t : chart.triangles) {
      if (t < 0 || t >= static_cast<int>(seen.size()) || seen[t]) throw InvalidInput("a chart's triangles are not its own");
      seen[t] = 1;
    }
    for (int v : chart.nodes) {
      if (v < 0 || v >= static_cast<int>(map.image.size())) throw InvalidInput("a chart refers to a point that does not exist");
    }
  }
  if (std::count(seen.begin(), seen.end(), 0) > 0) throw InvalidInput("a boundary triangle belongs to no chart");
}

/// Area of a component's boundary in one plane, seen along +axis: positive where the component is below.
struct PlaneArea {
  int component, axis, plane, sheet;
  int chart;  ///< the boundary chart there, or -1 for a cut
  double area;
};

struct Box {
  std::array<std::array<int, 2>, 3> plane{{{-1, -1}, {-1, -1}, {-1, -1}}}, sheet{{{-1, -1}, {-1, -1}, {-1, -1}}}, chart{{{-1, -1}, {-1, -1}, {-1, -1}}};
};

class Assembly {
 public:
  Assembly(const TetMesh& mesh, const PolycuboidMap& map, const TetTopology& topology, const SheetCuts& cuts, const Pieces& pieces)
      : mesh_(mesh), map_(map), topology_(topology), cuts_(cuts), pieces_(pieces) {}

  BlockComplex run() {
    find_boxes();
    choose_blocks();
    find_neighbours();
    complex_.sheets = cuts_.sheets;
    complex_.unknown = cuts_.unknown;
    if (cuts_.all) drop_sheets();
    find_vertices();
    collect_tets();
    find_feature_vertices();
    for (int c = 0; c < static_cast<int>(map_.charts.size()); ++c) {
      if (cuts_.collapsed[c]) complex_.collapsed.push_back(c);
    }
    return std::move(complex_);
  }

 private:
  double extent(const Box& box, int axis) const { return cuts_.planes[axis][box.plane[axis][1]] - cuts_.planes[axis][box.plane[axis][0]]; }

  /// The box of every component. Over the planes of an axis the net areas sum to 0; a block has its face's area at its high plane, the
  /// opposite at its low plane, and nothing between: folds of tets and of charts cancel.
  void find_boxes() {
    std::vector<PlaneArea> areas;
    areas.reserve(2 * pieces_.fluxes.size() + pieces_.chart_areas.size());
    for (const Flux& f : pieces_.fluxes) {
      areas.push_back({f.low, f.axis, f.plane, f.sheet, -1, f.area});
      areas.push_back({f.high, f.axis, f.plane, f.sheet, -1, -f.area});
    }
    for (const ChartArea& a : pieces_.chart_areas) {
      if (cuts_.collapsed[a.chart]) continue;
      areas.push_back({a.component, map_.charts[a.chart].axis, cuts_.chart_plane[a.chart], cuts_.chart_sheet[a.chart], a.chart, a.area});
    }
    const auto key = [](const PlaneArea& p) { return std::array{p.component, p.axis, p.plane, p.sheet, p.chart}; };
    std::stable_sort(areas.begin(), areas.end(), [&](const PlaneArea& a, const PlaneArea& b) { return key(a) < key(b); });
    boxes_.assign(pieces_.volume.size(), {});
    std::vector<std::array<std::array<double, 2>, 3>> best(boxes_.size(), {{{0, 0}, {0, 0}, {0, 0}}});
    for (std::size_t i = 0; i < areas.size();) {
      const PlaneArea& p = areas[i];
      double total = 0;
      std::array<double, 2> best_part{0, 0};
      std::array<std::size_t, 2> part_at{i, i};
      while (i < areas.size() && areas[i].component == p.component && areas[i].axis == p.axis && areas[i].plane == p.plane) {
        double part = 0;
        const std::size_t begin = i;
        for (; i < areas.size() && key(areas[i]) == key(areas[begin]); ++i) part += areas[i].area;
        total += part;
        for (int s : {0, 1}) {
          const double towards = s == 1 ? part : -part;
          if (towards <= best_part[s]) continue;
          best_part[s] = towards;
          part_at[s] = begin;
        }
      }
      const int side = total > 0 ? 1 : 0;
      if (std::abs(total) <= best[p.component][p.axis][side]) continue;
      best[p.component][p.axis][side] = std::abs(total);
      Box& box = boxes_[p.component];
      box.plane[p.axis][side] = p.plane;
      box.sheet[p.axis][side] = areas[part_at[side]].sheet;
      box.chart[p.axis][side] = areas[part_at[side]].chart;
    }
  }

  void choose_blocks() {
    block_of_.assign(boxes_.size(), -1);
    double total = 0, kept = 0;
    std::vector<int> blamed;
    for (std::size_t k = 0; k < boxes_.size(); ++k) {
      const Box& box = boxes_[k];
      total += pieces_.volume[k];
      double box_volume = 1;
      bool solid = true, upright = true;
      for (int d = 0; d < 3 && solid; ++d) {
        solid = box.plane[d][0] >= 0 && box.plane[d][1] >= 0 && box.plane[d][1] != box.plane[d][0];
        upright = upright && box.plane[d][1] > box.plane[d][0];
        if (solid) box_volume *= std::abs(extent(box, d));
      }
      const double degree = solid ? pieces_.volume[k] / box_volume : 0;
      if (std::abs(degree) < 1e-3) continue;
      if (std::abs(degree - 1) > 1e-3 || !upright) {
        // Where charts are in the wrong order the solid is inside out, or twice in one place.
        for (int d = 0; d < 3; ++d) {
          for (int sheet : box.sheet[d]) blamed.insert(blamed.end(), cuts_.sheets[sheet].charts.begin(), cuts_.sheets[sheet].charts.end());
        }
        continue;
      }
      Block block;
      block.volume = box_volume;
      for (int d = 0; d < 3; ++d) {
        block.sheets[d] = box.sheet[d];
        for (int s : {0, 1}) block.charts[d][s] = cuts_.sheets[box.sheet[d][s]].unknown;
      }
      block.neighbours.fill(-1);
      block.side_chart.fill(-1);
      kept += box_volume;
      block_of_[k] = static_cast<int>(complex_.blocks.size());
      component_of_.push_back(static_cast<int>(k));
      planes_.push_back(box.plane);
      complex_.blocks.push_back(std::move(block));
    }
    if (!blamed.empty()) fail("the charts' planes do not bound a volume", std::move(blamed), mesh_, map_);
    if (complex_.blocks.empty()) fail("the image of the map has no volume", {}, mesh_, map_);
    if (std::abs(total - kept) > 1e-6 * kept) fail("the blocks do not fill the image of the map", {}, mesh_, map_);
  }

  double side_area(const Block& block, int component, int axis) const { return block.volume / extent(boxes_[component], axis); }

  void find_neighbours() {
    // Components of no volume below a block's low side hold the boundary triangles of the chart there.
    std::vector<std::vector<std::pair<int, double>>> charts_in(boxes_.size());
    for (const ChartArea& a : pieces_.chart_areas) {
      auto& list = charts_in[a.component];
      const auto known = std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.first == a.chart; });
      if (known == list.end()) {
        list.push_back({a.chart, a.area});
      } else {
        known->second += a.area;
      }
    }
    std::vector<std::array<double, 3>> best(complex_.blocks.size(), {0, 0, 0});
    for (const Flux& f : pieces_.fluxes) {
      const int high = block_of_[f.high], low = block_of_[f.low];
      if (high >= 0 && boxes_[f.high].plane[f.axis][0] == f.plane) {
        Block& block = complex_.blocks[high];
        if (low >= 0) {
          if (boxes_[f.low].plane[f.axis][1] != f.plane || f.area < 0.5 * side_area(block, f.high, f.axis)) continue;
          block.neighbours[low_side(f.axis)] = low;
          complex_.blocks[low].neighbours[2 * f.axis + 1] = high;
        } else {
          for (auto [chart, area] : charts_in[f.low]) {
            if (cuts_.collapsed[chart] || map_.charts[chart].axis != f.axis || cuts_.chart_plane[chart] != f.plane) continue;
            const double weight = std::min(-area, f.area);
            if (weight <= best[high][f.axis]) continue;
            best[high][f.axis] = weight;
            block.side_chart[low_side(f.axis)] = chart;
          }
        }
      }
    }
    for (std::size_t b = 0; b < complex_.blocks.size(); ++b) {
      Block& block = complex_.blocks[b];
      for (int d = 0; d < 3; ++d) {
        if (block.neighbours[low_side(d)] >= 0) block.side_chart[low_side(d)] = -1;
        if (block.neighbours[2 * d + 1] < 0) block.side_chart[2 * d + 1] = boxes_[component_of_[b]].chart[d][1];
      }
    }
    find_behind_folds(charts_in);
    close_slits();
  }

  /// Sides whose chart or neighbour hides behind components of no volume: the nearest one through cuts in the side's plane.
  void find_behind_folds(const std::vector<std::vector<std::pair<int, double>>>& charts_in) {
    std::vector<std::vector<int>> cuts_of(boxes_.size());
    for (int i = 0; i < static_cast<int>(pieces_.fluxes.size()); ++i) {
      cuts_of[pieces_.fluxes[i].low].push_back(i);
      cuts_of[pieces_.fluxes[i].high].push_back(i);
    }
    for (int b = 0; b < static_cast<int>(complex_.blocks.size()); ++b) {
      for (int side = 0; side < 6; ++side) {
        Block& block = complex_.blocks[b];
        if (block.neighbours[side] >= 0 || block.side_chart[side] >= 0) continue;
        const int axis = side / 2, plane = planes_[b][axis][side % 2];
        std::vector<int> reached{component_of_[b]};
        double best = 0;
        for (std::size_t i = 0; i < reached.size(); ++i) {
          for (int c : cuts_of[reached[i]]) {
            const Flux& f = pieces_.fluxes[c];
            const int to = f.low == reached[i] ? f.high : f.low;
            if (f.axis != axis || f.plane != plane || f.area == 0 || std::find(reached.begin(), reached.end(), to) != reached.end()) continue;
            const int other = block_of_[to];
            if (other < 0) {
              reached.push_back(to);
            } else if (fits(b, other, side) && std::abs(f.area) > best) {
              best = std::abs(f.area);
              block.neighbours[side] = other;
              block.side_chart[side] = -1;
            }
          }
          if (i == 0) continue;
          for (auto [chart, area] : charts_in[reached[i]]) {
            const double towards = side % 2 == 1 ? area : -area;
            if (cuts_.collapsed[chart] || map_.charts[chart].axis != axis || cuts_.chart_plane[chart] != plane || towards <= best) continue;
            best = towards;
            block.neighbours[side] = -1;
            block.side_chart[side] = chart;
          }
        }
        if (const int n = block.neighbours[side]; n >= 0) {
          complex_.blocks[n].neighbours[side ^ 1] = b;
          complex_.blocks[n].side_chart[side ^ 1] = -1;
        }
      }
    }
  }

  /// Whether a block has the same rectangle on the other side of a block's side, and nothing there yet.
  bool fits(int block, int other, int side) const {
    const int axis = side / 2;
    if (complex_.blocks[other].neighbours[side ^ 1] >= 0 || planes_[other][axis][1 - side % 2] != planes_[block][axis][side % 2]) return false;
    return planes_[other][(axis + 1) % 3] == planes_[block][(axis + 1) % 3] && planes_[other][(axis + 2) % 3] == planes_[block][(axis + 2) % 3];
  }

  /// Where a chart overshoots its border and folds back, the two layers cancel, but the blocks on both sides have them as their boundary:
  /// one of them faces the wrong way. Such sides adjoin.
  void close_slits() {
    using Face = std::array<int, 7>;  // axis, plane, lateral planes, chart
    const auto face_of = [&](std::size_t b, int side) {
      const int d = side / 2, u = (d + 1) % 3, v = (d + 2) % 3;
      const auto& p = planes_[b];
      return Face{d, p[d][side % 2], p[u][0], p[u][1], p[v][0], p[v][1], complex_.blocks[b].side_chart[side]};
    };
    std::map<Face, std::array<std::vector<int>, 2>> open;
    bool wrong = false;
    for (std::size_t b = 0; b < complex_.blocks.size(); ++b) {
      for (int side = 0; side < 6; ++side) {
        const Block& block = complex_.blocks[b];
        if (block.neighbours[side] >= 0 || block.side_chart[side] < 0) continue;
        wrong = wrong || (cuts_.sign[block.side_chart[side]] > 0) != (side % 2 == 1);
        open[face_of(b, side)][side % 2].push_back(static_cast<int>(b));
      }
    }
    if (!wrong) return;
    for (const auto& [face, blocks] : open) {
      const int d = face[0];
      for (std::size_t i = 0; i < std::min(blocks[0].size(), blocks[1].size()); ++i) {
        Block &high = complex_.blocks[blocks[0][i]], &low = complex_.blocks[blocks[1][i]];
        high.neighbours[low_side(d)] = blocks[1][i];
        low.neighbours[2 * d + 1] = blocks[0][i];
        high.side_chart[low_side(d)] = low.side_chart[2 * d + 1] = -1;
      }
    }
  }

  /// After a cut along all of every plane.
  void drop_sheets() {
    std::vector<std::array<int, 3>> touched;
    for (int c = 0; c < static_cast<int>(map_.charts.size()); ++c) {
      if (map_.charts[c].sign != 0) continue;
      for_blocks_at_nodes(c, [&](int node, int block) {
        const int axis = map_.charts[c].axis;
        for (int s : {0, 1}) {
          if (planes_[block][axis][s] == cuts_.chart_plane[c] && in_box(cuts_.image[node], block)) touched.push_back({block, 2 * axis + s, c});
        }
      });
    }
    Coarse coarse;
    try {
      coarse = coarsen(complex_.blocks, planes_, touched, map_.charts, {});
    } catch (const StageFailed&) {
      // Sheets that folds leave incomplete: keep all, charts of one plane sharing their integer where only that joins a sheet to a chart.
      std::array<std::vector<int>, 3> chart_of_plane;
      for (int d = 0; d < 3; ++d) chart_of_plane[d].resize(cuts_.planes[d].size());
      for (int c = static_cast<int>(map_.charts.size()) - 1; c >= 0; --c) chart_of_plane[map_.charts[c].axis][cuts_.chart_plane[c]] = c;
      coarse = coarsen(complex_.blocks, planes_, touched, map_.charts, chart_of_plane);
    }
    complex_.blocks = std::move(coarse.blocks);
    complex_.sheets = std::move(coarse.sheets);
    complex_.unknown = std::move(coarse.unknown);
    planes_ = std::move(coarse.planes);
    for (int& b : block_of_) {
      if (b >= 0) b = coarse.block_of[b];
    }
  }

  /// Calls visit(node, block) for the blocks that the tets round a chart's nodes cover; more than once for some.
  template <class Visit>
  void for_blocks_at_nodes(int chart, const Visit& visit) const {
    for (int node : map_.charts[chart].nodes) {
      for (int i = topology_.node_tets_first[node]; i < topology_.node_tets_first[node + 1]; ++i) {
        const int t = topology_.node_tets[i];
        for (int p = pieces_.offset[t]; p < pieces_.offset[t + 1]; ++p) {
          const int block = pieces_.component[p] < 0 ? -1 : block_of_[pieces_.component[p]];
          if (block >= 0) visit(node, block);
        }
      }
    }
  }

  bool in_box(const Vec3& place, int block) const {
    for (int d = 0; d < 3; ++d) {
      const auto& plane = planes_[block][d];
      if (place[d] < cuts_.planes[d][plane[0]] - cuts_.tolerance || place[d] > cuts_.planes[d][plane[1]] + cuts_.tolerance) return false;
    }
    return true;
  }

  void find_vertices() {
    auto& blocks = complex_.blocks;
    UnionFind same(8 * blocks.size());
    for (int b = 0; b < static_cast<int>(blocks.size()); ++b) {
      for (int d = 0; d < 3; ++d) {
        const int n = blocks[b].neighbours[2 * d + 1];
        if (n < 0) continue;
        for (int c = 0; c < 8; ++c) {
          if (kCornerCoordinates[c][d] == 1) same.unite(8 * b + c, 8 * n + mirrored(c, d));
        }
      }
    }
    std::vector<int> number(8 * blocks.size(), -1);
    for (int i = 0; i < static_cast<int>(number.size()); ++i) {
      const int root = same.find(i);
      if (root == i) {
        number[i] = complex_.vertex_count++;
        const Block& block = blocks[i / 8];
        const auto& side = kCornerCoordinates[i % 8];
        complex_.vertex_charts.push_back({block.charts[0][side[0]], block.charts[1][side[1]], block.charts[2][side[2]]});
      }
      blocks[i / 8].corners[i % 8] = number[root];
    }
  }

  /// The corner on the other side along axis d.
  static int mirrored(int corner, int d) {
    auto wanted = kCornerCoordinates[corner];
    wanted[d] = 1 - wanted[d];
    return static_cast<int>(std::find(kCornerCoordinates.begin(), kCornerCoordinates.end(), wanted) - kCornerCoordinates.begin());
  }

  void collect_tets() {
    for (int t = 0; t < static_cast<int>(mesh_.tets.size()); ++t) {
      for (int p = pieces_.offset[t]; p < pieces_.offset[t + 1]; ++p) {
        const int b = pieces_.component[p] < 0 ? -1 : block_of_[pieces_.component[p]];
        if (b >= 0 && (complex_.blocks[b].tets.empty() || complex_.blocks[b].tets.back() != t)) complex_.blocks[b].tets.push_back(t);
      }
    }
  }

  void find_feature_vertices() {
    complex_.feature_vertices.resize(map_.charts.size());
    for (int c = 0; c < static_cast<int>(map_.charts.size()); ++c) {
      if (map_.charts[c].sign != 0) continue;
      auto& found = complex_.feature_vertices[c];
      for_blocks_at_nodes(c, [&](int node, int block) { add_corner_at(cuts_.image[node], block, found); });
      std::sort(found.begin(), found.end());
      found.erase(std::unique(found.begin(), found.end()), found.end());
    }
  }

  void add_corner_at(const Vec3& place, int block, std::vector<int>& found) const {
    std::array<int, 3> side{};
    for (int d = 0; d < 3; ++d) {
      const auto& plane = planes_[block][d];
      if (std::abs(place[d] - cuts_.planes[d][plane[0]]) <= cuts_.tolerance) {
        side[d] = 0;
      } else if (std::abs(place[d] - cuts_.planes[d][plane[1]]) <= cuts_.tolerance) {
        side[d] = 1;
      } else {
        return;
      }
    }
    const auto corner = std::find(kCornerCoordinates.begin(), kCornerCoordinates.end(), side) - kCornerCoordinates.begin();
    found.push_back(complex_.blocks[block].corners[static_cast<std::size_t>(corner)]);
  }

  const TetMesh& mesh_;
  const PolycuboidMap& map_;
  const TetTopology& topology_;
  const SheetCuts& cuts_;
  const Pieces& pieces_;
  std::vector<Box> boxes_;           ///< per component
  std::vector<int> block_of_;        ///< per component, or -1
  std::vector<int> component_of_;    ///< per block, before sheets are dropped
  std::vector<BlockPlanes> planes_;  ///< per block
  BlockComplex complex_;
};

BlockComplex extract(const TetMesh& tets, const PolycuboidMap& map, const TetTopology& topology, bool all, const Monitor& monitor) {
  monitor.progress("blocks", 0);
  const SheetCuts cuts = find_sheets(tets, map, topology, all, monitor);
  monitor.progress("blocks", 0.1);
  Pieces pieces(tets, map, topology, cuts);
  pieces.run(monitor);
  monitor.progress("blocks", 0.8);
  BlockComplex complex = Assembly(tets, map, topology, cuts, pieces).run();
  const BlockReport report = check(complex, map);
  if (!report.lost_charts.empty()) fail("charts that bound no volume in the image of the map", report.lost_charts, tets, map);
  if (report.bare_sides > 0) fail("blocks have sides on no chart", {}, tets, map);
  if (report.asymmetric_neighbours > 0) fail("blocks do not fit their neighbours", {}, tets, map);
  if (report.nonmanifold_edges > 0) fail("charts touch, the boundary of the blocks is not a manifold", report.touching_charts, tets, map);
  if (const int euler = euler_characteristic(tets.triangles); report.euler != euler) {
    fail("the blocks do not have the topology of the solid, Euler characteristic " + std::to_string(report.euler) + " instead of " + std::to_string(euler), {},
         tets, map);
  }
  monitor.progress("blocks", 1);
  return complex;
}

}  // namespace

BlockComplex extract_blocks(const TetMesh& tets, const PolycuboidMap& map, const Monitor& monitor) {
  validate(tets, map);
  const TetTopology topology = find_topology(tets);
  // Folds on the boundary can tear a sheet where it starts. Cutting along all of every plane cannot, but costs more.
  try {
    return extract(tets, map, topology, false, monitor);
  } catch (const StageFailed&) {
    return extract(tets, map, topology, true, monitor);
  }
}

}  // namespace polycube
