#include "hex/geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "hex/locate.h"
#include "hex/tuning.h"

namespace polycube {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Edge of the tet mesh's boundary.
struct BoundaryEdge {
  int a, b;
  int triangle;  ///< one that it bounds
};

class Placement {
 public:
  Placement(const TetMesh& mesh, const PolycuboidMap& map, const BlockComplex& complex, Connectivity& connectivity)
      : mesh_(mesh), map_(map), complex_(complex), connectivity_(connectivity), hexes_(connectivity.hexes) {
    find_owners();
    find_edges();
    Vec3 low = map.image.front(), high = low;
    for (const Vec3& p : map.image) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    on_feature_ = kHexTuning.on_feature * (high - low).maxCoeff();
    chart_grids_.resize(map.charts.size());
    block_grids_.resize(complex.blocks.size());
  }

  void run(const Monitor& monitor) {
    const int nodes = static_cast<int>(hexes_.mesh.points.size());
    std::vector<std::array<int, 3>> node_charts(nodes, {-1, -1, -1});
    for (std::size_t q = 0; q < hexes_.quads.size(); ++q) {
      const int chart = hexes_.quad_chart[q];
      for (int n : hexes_.quads[q]) {
        int& known = node_charts[n][map_.charts[chart].axis];
        if (known < 0 || chart < known) known = chart;
      }
    }
    for (int n = 0; n < nodes; ++n) {
      if (n % 4096 == 0) monitor.progress("hex", 0.2 + 0.7 * n / nodes);
      place(n, node_charts[n]);
    }
    hexes_.quad_triangle.resize(hexes_.quads.size());
    for (std::size_t q = 0; q < hexes_.quads.size(); ++q) {
      const int chart = hexes_.quad_chart[q];
      Vec3 centre = Vec3::Zero();
      for (int n : hexes_.quads[q]) centre += hexes_.param[n] / 4;
      centre[map_.charts[chart].axis] = map_.charts[chart].value;
      near_blocks_.assign(1, connectivity_.quad_block[q]);
      hexes_.quad_triangle[q] = find_triangle(chart, centre).first;
    }
  }

 private:
  /// The tet of every boundary triangle.
  void find_owners() {
    std::map<Triangle, int> triangle_of;
    const auto key = [](Triangle t) {
      std::sort(t.begin(), t.end());
      return t;
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) triangle_of.emplace(key(mesh_.triangles[t]), static_cast<int>(t));
    owner_.assign(mesh_.triangles.size(), -1);
    std::vector<char> on_boundary(mesh_.points.size(), 0);
    for (const Triangle& t : mesh_.triangles) {
      for (int v : t) on_boundary[v] = 1;
    }
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const Tet& tet = mesh_.tets[t];
      for (const Triangle& f :
           {Triangle{tet[1], tet[2], tet[3]}, Triangle{tet[0], tet[2], tet[3]}, Triangle{tet[0], tet[1], tet[3]}, Triangle{tet[0], tet[1], tet[2]}}) {
        if (!on_boundary[f[0]] || !on_boundary[f[1]] || !on_boundary[f[2]]) continue;
        if (const auto at = triangle_of.find(key(f)); at != triangle_of.end()) owner_[at->second] = static_cast<int>(t);
      }
    }
  }

  /// Boundary edges between charts, corner nodes, and the segments of features.
  void find_edges() {
    std::vector<int> chart_of(mesh_.triangles.size(), -1);
    node_charts_.resize(mesh_.points.size());
    for (int c = 0; c < static_cast<int>(map_.charts.size()); ++c) {
      for (int t : map_.charts[c].triangles) chart_of[t] = c;
      for (int n : map_.charts[c].nodes) node_charts_[n].push_back(c);  // ascending, features too
    }
    std::map<Segment, int> open;  // edges with their first triangle
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3];
        const auto [at, fresh] = open.try_emplace({std::min(a, b), std::max(a, b)}, t);
        if (fresh) continue;
        const int c1 = chart_of[at->second], c2 = chart_of[t];
        if (c1 != c2) between_[{std::min(c1, c2), std::max(c1, c2)}].push_back({at->first[0], at->first[1], t});
      }
    }
    feature_edges_.resize(map_.charts.size());
    std::vector<Segment> segments = mesh_.segments;
    if (segments.empty()) {
      for (const auto& [edge, triangle] : open) segments.push_back(edge);
    }
    for (Segment s : segments) {
      if (s[0] > s[1]) std::swap(s[0], s[1]);
      const auto at = open.find(s);
      if (at == open.end()) continue;
      for (int c : node_charts_[s[0]]) {
        if (map_.charts[c].sign == 0 && stands_on(s[1], c)) feature_edges_[c].push_back({s[0], s[1], at->second});
      }
    }
  }

  bool stands_on(int point, int chart) const { return std::binary_search(node_charts_[point].begin(), node_charts_[point].end(), chart); }
  bool stands_on_all(int point, const std::array<int, 3>& charts) const {
    return std::all_of(charts.begin(), charts.end(), [&](int c) { return c < 0 || stands_on(point, c); });
  }

  /// Whether a tet covers one of the blocks at hand: tells apart sheets of an image that overlaps itself.
  bool near(int tet) const {
    return std::any_of(near_blocks_.begin(), near_blocks_.end(), [&](int b) {
      const auto& tets = complex_.blocks[b].tets;
      return std::binary_search(tets.begin(), tets.end(), tet);
    });
  }

  void place(int n, const std::array<int, 3>& charts) {
    const auto begin = connectivity_.places.begin() + connectivity_.place_first[n];
    const auto end = connectivity_.places.begin() + connectivity_.place_first[n + 1];
    // Coordinates that a chart fixes; the others from the middle of what the node stands for.
    Vec3 wanted, low = begin->low, high = begin->high;
    for (auto p = begin; p != end; ++p) {
      low = low.cwiseMin(p->low);
      high = high.cwiseMax(p->high);
    }
    std::array<char, 3> fixed{};
    for (int d = 0; d < 3; ++d) {
      wanted[d] = charts[d] >= 0 ? map_.charts[charts[d]].value : (low[d] + high[d]) / 2;
      fixed[d] = charts[d] >= 0;
    }
    for (int i = hexes_.node_feature_first[n]; i < hexes_.node_feature_first[n + 1]; ++i) {
      const Chart& feature = map_.charts[hexes_.node_features[i]];
      if (fixed[feature.axis]) continue;
      wanted[feature.axis] = feature.value;
      fixed[feature.axis] = 1;
    }
    auto best = begin;
    double best_miss = kInfinity;
    Vec3 param = wanted;
    near_blocks_.clear();
    for (auto p = begin; p != end; ++p) {
      near_blocks_.push_back(p->block);
      const Vec3 clamped_here = wanted.cwiseMax(p->low).cwiseMin(p->high);
      double miss = 0;
      for (int d = 0; d < 3; ++d) miss += (fixed[d] ? 1.0 : 1e-3) * std::abs(clamped_here[d] - wanted[d]);
      if (miss >= best_miss) continue;
      best_miss = miss;
      best = p;
      param = clamped_here;
    }
    for (int d = 0; d < 3; ++d) {
      if (charts[d] >= 0) param[d] = wanted[d];
    }
    hexes_.param[n] = param;
    const bool boundary = charts[0] >= 0 || charts[1] >= 0 || charts[2] >= 0;
    hexes_.mesh.points[n] = boundary ? boundary_point(n, charts) : inner_point(best->block, param);
  }

  // ---- inside ----

  Vec3 inner_point(int block, const Vec3& p) {
    const std::vector<int>& tets = complex_.blocks[block].tets;
    auto& grid = block_grids_[block];
    if (!grid) {
      std::vector<BoxGrid::Box> boxes;
      boxes.reserve(tets.size());
      for (int t : tets) {
        const auto c = image(mesh_.tets[t]);
        boxes.push_back({c[0].cwiseMin(c[1]).cwiseMin(c[2]).cwiseMin(c[3]), c[0].cwiseMax(c[1]).cwiseMax(c[2]).cwiseMax(c[3])});
      }
      grid.emplace(boxes);
    }
    // Among the tets that contain p a positive one, the one that contains it most deeply.
    int best = -1;
    bool best_positive = false;
    double best_depth = -kHexTuning.inside;
    std::array<double, 4> best_coordinates{};
    const auto [begin, end] = grid->candidates(p);
    for (auto i = begin; i != end; ++i) {
      const auto corners = image(mesh_.tets[tets[*i]]);
      const auto c = tet_coordinates(corners, p);
      const double depth = *std::min_element(c.begin(), c.end());
      if (!(depth >= -kHexTuning.inside)) continue;
      const bool positive = (corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) > 0;
      if (best >= 0 && (positive < best_positive || (positive == best_positive && depth <= best_depth))) continue;
      best = tets[*i];
      best_positive = positive;
      best_depth = depth;
      best_coordinates = c;
    }
    if (best < 0) {
      // In a fold no tet may contain it: the nearest one of the block.
      double nearest = kInfinity;
      for (int t : tets) {
        const auto corners = image(mesh_.tets[t]);
        auto c = tet_coordinates(corners, p);
        if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); })) c = {0.25, 0.25, 0.25, 0.25};
        c = clamped(c);
        Vec3 q = Vec3::Zero();
        for (int k = 0; k < 4; ++k) q += c[k] * corners[k];
        const double distance = (q - p).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = t;
        best_coordinates = c;
      }
    }
    const auto c = clamped(best_coordinates);
    Vec3 result = Vec3::Zero();
    for (int k = 0; k < 4; ++k) result += c[k] * mesh_.points[mesh_.tets[best][k]];
    return result;
  }

  // ---- on the boundary ----

  Vec3 boundary_point(int n, const std::array<int, 3>& charts) {
    const Vec3& p = hexes_.param[n];
    const int axes = (charts[0] >= 0) + (charts[1] >= 0) + (charts[2] >= 0);
    const int* features_begin = hexes_.node_features.data() + hexes_.node_feature_first[n];
    const int* features_end = hexes_.node_features.data() + hexes_.node_feature_first[n + 1];
    if (axes < 3) {
      // A feature's node, then its segment, where the image of this node lies on one.
      double nearest = on_feature_;
      int point = -1;
      for (auto f = features_begin; f != features_end; ++f) {
        for (int v : map_.charts[*f].nodes) {
          const double distance = (map_.image[v] - p).norm();
          if (distance >= nearest || !stands_on_all(v, charts)) continue;
          nearest = distance;
          point = v;
        }
      }
      if (point >= 0) return mesh_.points[point];
    }
    if (axes == 1) {
      for (auto f = features_begin; f != features_end; ++f) {
        if (const auto found = on_edges(feature_edges_[*f], p, charts, on_feature_)) return *found;
      }
    }
    if (axes == 3) {
      if (const int v = corner(p, charts); v >= 0) return mesh_.points[v];
    }
    if (axes >= 2) {
      std::optional<Vec3> found;
      for (int i = 0; i < 3 && !found; ++i) {
        const int a = charts[i], b = charts[(i + 1) % 3];
        if (a < 0 || b < 0) continue;
        const auto edges = between_.find({std::min(a, b), std::max(a, b)});
        if (edges != between_.end()) found = on_edges(edges->second, p, {-1, -1, -1}, kInfinity);
      }
      if (found) return *found;
    }
    const int chart = *std::max_element(charts.begin(), charts.end());
    const auto [triangle, c] = find_triangle(chart, p);
    Vec3 result = Vec3::Zero();
    for (int k = 0; k < 3; ++k) result += c[k] * mesh_.points[mesh_.triangles[triangle][k]];
    return result;
  }

  /// Nearest place to p on edges whose ends stand on all of `charts`; of those at hand before others.
  std::optional<Vec3> on_edges(const std::vector<BoundaryEdge>& edges, const Vec3& p, const std::array<int, 3>& charts, double within) const {
    double nearest = kInfinity;
    bool nearest_near = false;
    std::optional<Vec3> result;
    for (const BoundaryEdge& e : edges) {
      if (!stands_on_all(e.a, charts) || !stands_on_all(e.b, charts)) continue;
      const Vec3 &a = map_.image[e.a], &b = map_.image[e.b];
      const double t = segment_parameter(a, b, p);
      const double distance = (a + t * (b - a) - p).norm();
      if (distance > within) continue;
      const bool is_near = near(owner_[e.triangle]);
      if (result && (is_near < nearest_near || (is_near == nearest_near && distance >= nearest))) continue;
      nearest = distance;
      nearest_near = is_near;
      result = mesh_.points[e.a] + t * (mesh_.points[e.b] - mesh_.points[e.a]);
    }
    return result;
  }

  /// The point of the tet mesh where three charts meet that is nearest in the image, -1 where they do not meet.
  int corner(const Vec3& p, const std::array<int, 3>& charts) const {
    int best = -1;
    double nearest = kInfinity;
    for (int v : map_.charts[charts[0]].nodes) {
      if (!stands_on(v, charts[1]) || !stands_on(v, charts[2])) continue;
      double distance = (map_.image[v] - p).norm();
      if (!corner_near(v)) distance += 1e6 * (1 + distance);
      if (distance >= nearest) continue;
      nearest = distance;
      best = v;
    }
    return best;
  }

  bool corner_near(int point) const {
    return std::any_of(near_blocks_.begin(), near_blocks_.end(), [&](int b) {
      const auto& tets = complex_.blocks[b].tets;
      return std::any_of(tets.begin(), tets.end(), [&](int t) { return std::count(mesh_.tets[t].begin(), mesh_.tets[t].end(), point) > 0; });
    });
  }

  /// The triangle of a chart that contains p, or the nearest, with coordinates inside of it.
  std::pair<int, std::array<double, 3>> find_triangle(int chart, const Vec3& p) {
    const std::vector<int>& triangles = map_.charts[chart].triangles;
    const int axis = map_.charts[chart].axis;
    auto& grid = chart_grids_[chart];
    if (!grid) {
      std::vector<BoxGrid::Box> boxes;
      boxes.reserve(triangles.size());
      for (int t : triangles) {
        const auto c = image(mesh_.triangles[t]);
        boxes.push_back({c[0].cwiseMin(c[1]).cwiseMin(c[2]), c[0].cwiseMax(c[1]).cwiseMax(c[2])});
      }
      grid.emplace(boxes);
    }
    int best = -1;
    std::array<int, 2> best_rank{-1, -1};
    double best_depth = -kInfinity;
    std::array<double, 3> best_coordinates{};
    const auto [begin, end] = grid->candidates(p);
    for (auto i = begin; i != end; ++i) {
      const int t = triangles[*i];
      const auto corners = image(mesh_.triangles[t]);
      const auto c = triangle_coordinates(corners, p, axis);
      const double depth = *std::min_element(c.begin(), c.end());
      if (!(depth >= -kHexTuning.inside)) continue;
      const double area = (corners[1] - corners[0]).cross(corners[2] - corners[0])[axis] * map_.charts[chart].sign;
      const std::array<int, 2> rank{near(owner_[t]), area > 0};
      if (rank < best_rank || (rank == best_rank && depth <= best_depth)) continue;
      best = t;
      best_rank = rank;
      best_depth = depth;
      best_coordinates = c;
    }
    if (best < 0) {
      double nearest = kInfinity;
      for (int t : triangles) {
        const auto corners = image(mesh_.triangles[t]);
        auto c = triangle_coordinates(corners, p, axis);
        if (!std::all_of(c.begin(), c.end(), [](double x) { return std::isfinite(x); })) c = {1.0 / 3, 1.0 / 3, 1.0 / 3};
        c = clamped(c);
        Vec3 q = Vec3::Zero();
        for (int k = 0; k < 3; ++k) q += c[k] * corners[k];
        const double distance = (q - p).squaredNorm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = t;
        best_coordinates = c;
      }
    }
    return {best, clamped(best_coordinates)};
  }

  template <std::size_t N>
  std::array<Vec3, N> image(const std::array<int, N>& corners) const {
    std::array<Vec3, N> result;
    for (std::size_t k = 0; k < N; ++k) result[k] = map_.image[corners[k]];
    return result;
  }

  const TetMesh& mesh_;
  const PolycuboidMap& map_;
  const BlockComplex& complex_;
  Connectivity& connectivity_;
  HexComplex& hexes_;
  std::vector<int> owner_;                                           ///< per boundary triangle: its tet
  std::vector<std::vector<int>> node_charts_;                        ///< per tet mesh point: charts and features it stands on
  std::map<std::array<int, 2>, std::vector<BoundaryEdge>> between_;  ///< by pair of charts
  std::vector<std::vector<BoundaryEdge>> feature_edges_;             ///< per chart
  double on_feature_ = 0;
  std::vector<std::optional<BoxGrid>> chart_grids_, block_grids_;  ///< made when first asked
  std::vector<int> near_blocks_;                                   ///< of the node at hand
};

}  // namespace

void place_nodes(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks, Connectivity& connectivity, const Monitor& monitor) {
  Placement(tets, map, blocks, connectivity).run(monitor);
}

}  // namespace polycube
