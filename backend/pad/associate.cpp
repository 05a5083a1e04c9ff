#include "pad/associate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "core/charts.h"
#include "core/error.h"
#include "pad/tuning.h"

namespace polycube {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::uint64_t key(int a, int b) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32 | static_cast<std::uint32_t>(b); }

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = d.squaredNorm() > 0 ? std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

// Half edges of the boundary quads: number 4 q + k begins at corner k of quad q, which is on its left.
struct Surface {
  explicit Surface(const std::vector<Quad>& quads, std::size_t n_points) : out(n_points), halves(n_points) {
    std::vector<std::vector<std::pair<int, int>>> leaving(n_points);
    for (int q = 0; q < static_cast<int>(quads.size()); ++q) {
      for (int k = 0; k < 4; ++k) leaving[quads[q][k]].emplace_back(quads[q][(k + 1) % 4], 4 * q + k);
    }
    for (std::size_t n = 0; n < n_points; ++n) {
      std::sort(leaving[n].begin(), leaving[n].end());
      for (const auto& [to, half] : leaving[n]) {
        out[n].push_back(to);
        halves[n].push_back(half);
      }
    }
    twin.resize(4 * quads.size(), -1);
    for (int h = 0; h < static_cast<int>(twin.size()); ++h) {
      const int a = quads[h / 4][h % 4], b = quads[h / 4][(h + 1) % 4];
      const auto found = std::find(out[b].begin(), out[b].end(), a);
      if (found != out[b].end()) twin[h] = halves[b][static_cast<std::size_t>(found - out[b].begin())];
    }
  }
  int half(int a, int b) const {
    const auto found = std::find(out[a].begin(), out[a].end(), b);
    if (found == out[a].end()) throw std::out_of_range("no boundary edge joins the nodes");
    return halves[a][static_cast<std::size_t>(found - out[a].begin())];
  }
  int left_of(int a, int b) const { return half(a, b) / 4; }
  int right_of(int half) const {
    if (twin[half] < 0) throw std::out_of_range("the boundary is open");
    return twin[half] / 4;
  }

  std::vector<std::vector<int>> out;     // per node: neighbours, ascending
  std::vector<std::vector<int>> halves;  // those that go there
  std::vector<int> twin;                 // the half edge that goes back, -1 where there is none
};

// A CAD edge at one of its vertices.
struct Spoke {
  int edge = 0, end = 0;  // end 0: where the edge's chain begins
  int quads_to_next = 1;  // that belong between it and the next spoke, counter-clockwise seen from outside
};

struct Path {
  std::vector<int> nodes;
  double deviation = 0;  // mm, mean distance from the CAD edge
  double astray = 0;     // share of it that runs in or between other charts than the CAD edge
};

class Associator {
 public:
  Associator(const CadModel& model, const TetMesh& tets, const std::vector<Chart>& charts, const HexBoundary& b, const AssociateOptions& options,
             const Monitor& monitor)
      : model_(model), tets_(tets), b_(b), options_(options), monitor_(monitor), surface_(b.quads, b.points.size()) {
    node_charts_.resize(b.points.size());
    for (std::size_t q = 0; q < b.quads.size(); ++q) {
      for (int n : b.quads[q]) node_charts_[n].push_back(b.quad_chart[q]);
    }
    for (int n = 0; n < static_cast<int>(b.points.size()); ++n) {
      if (!node_charts_[n].empty()) nodes_.push_back(n);
    }
    tet_charts_.resize(tets.points.size());
    chart_of_triangle_.assign(tets.triangles.size(), -1);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
      for (int t : charts[c].triangles) {
        chart_of_triangle_[t] = c;
        for (int n : tets.triangles[t]) tet_charts_[n].push_back(c);
      }
    }
    for (auto* lists : {&node_charts_, &tet_charts_}) {
      for (std::vector<int>& list : *lists) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
      }
    }
    for (int t = 0; t < static_cast<int>(tets.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) triangle_left_[key(tets.triangles[t][k], tets.triangles[t][(k + 1) % 3])] = t;
    }
    face_triangles_.resize(model.face_count() + 1);
    triangle_sides_.resize(tets.triangles.size());
    std::unordered_map<std::uint64_t, int> side;
    for (int t = 0; t < static_cast<int>(tets.triangles.size()); ++t) {
      face_triangles_[tets.triangle_face[t]].push_back(t);
      for (int k = 0; k < 3; ++k) {
        const auto [from, to] = std::minmax(tets.triangles[t][k], tets.triangles[t][(k + 1) % 3]);
        triangle_sides_[t][k] = side.try_emplace(key(from, to), static_cast<int>(side.size())).first->second;
      }
    }
    sides_ = static_cast<int>(side.size());
    off_.resize(b.points.size());
    off_of_.assign(b.points.size(), 0);
    best_.resize(surface_.twin.size());
    before_.resize(surface_.twin.size());
    best_of_.assign(surface_.twin.size(), 0);
  }

  // Edges block each other's way. Those that found none go first the next time (rip up and reroute); the round that loses least counts.
  Association run(std::vector<CrowdedCorner>* crowded) {
    for (const int e : model_.edges()) {
      const CadEdge& edge = model_.edge(e);
      if (!edge.seam && !edge.degenerate && !edge.tiny) real_.push_back(e);
    }
    find_tips();
    find_places();
    failures_.assign(model_.edge_count() + 1, 0);
    find_spokes();
    std::optional<Association> best;
    double least = kNever;
    for (int round = 0, idle = 0; round < kPadTuning.rounds && idle < kPadTuning.patience; ++round, ++idle) {
      Association result = associate_once();
      double deviation = 0;
      for (int e : real_) deviation += path_[e].deviation;
      const double cost = static_cast<double>(result.lost_edges.size()) + 1e-6 * deviation / options_.size;
      int avoidable = 0;
      for (int e : result.lost_edges) {
        if (options_.edge_chains[e].size() < 2) continue;
        ++failures_[e];
        ++avoidable;
      }
      if (cost < least) {
        if (!best || result.lost_edges.size() < best->lost_edges.size()) idle = 0;
        least = cost;
        best = std::move(result);
        if (crowded) *crowded = crowded_corners();
      }
      if (avoidable == 0) break;
    }
    return std::move(*best);
  }

 private:
  Association associate_once() {
    lost_.assign(model_.edge_count() + 1, 1);
    for (int e : real_) {
      if (options_.edge_chains[e].size() > 1 && !ignored(e)) lost_[e] = 0;
    }
    place_vertices();
    route_all();
    // Give up one edge at a time until the regions are the patches.
    for (;;) {
      monitor_.check();
      Association result;
      const int culprit = regions(result);
      if (culprit == 0) return result;
      if (culprit < 0) throw StageFailed("pad", "the surface of the hexahedral mesh is not the surface of the part");
      lost_[culprit] = 1;
      path_[culprit] = {};
    }
  }

  // Points of faces where no CAD edge ends: a cone has its tip on a node all the same.
  void find_tips() {
    std::set<int> ends;
    for (int e : real_) ends.insert(model_.edge(e).vertices.begin(), model_.edge(e).vertices.end());
    for (const int e : model_.edges()) {
      if (model_.edge(e).tip && ends.count(model_.edge(e).vertices[0]) == 0) tips_.push_back(model_.edge(e).vertices[0]);
    }
    std::sort(tips_.begin(), tips_.end());
    tips_.erase(std::unique(tips_.begin(), tips_.end()), tips_.end());
  }

  // The CAD edges round every vertex in order, with the angles of the tet mesh's triangles between them.
  void find_spokes() {
    std::map<std::pair<int, int>, std::pair<int, int>> ends;  // (vertex's point, next point) -> (edge, end)
    for (int e : real_) {
      const auto& chain = options_.edge_chains[e];
      if (chain.size() < 2 || ignored(e)) continue;
      ends[{chain[0], chain[1]}] = {e, 0};
      ends[{chain.back(), chain[chain.size() - 2]}] = {e, 1};
    }
    spokes_.resize(model_.vertex_count() + 1);
    for (auto it = ends.begin(); it != ends.end(); ++it) {
      const int at = it->first.first;
      if (tets_.point_cad[at].dim != 0) continue;
      std::vector<Spoke>& spokes = spokes_[tets_.point_cad[at].id];
      if (!spokes.empty()) continue;
      int next = it->first.second;
      double angle = 0;
      do {
        if (const auto found = ends.find({at, next}); found != ends.end()) {
          if (!spokes.empty()) spokes.back().quads_to_next = quads_in(angle);
          spokes.push_back({found->second.first, found->second.second, 1});
          angle = 0;
        }
        const Triangle& t = tets_.triangles[triangle_left_.at(key(at, next))];
        const int beyond = t[0] == at ? t[2] : t[1] == at ? t[0] : t[1];
        const Vec3 a = tets_.points[next] - tets_.points[at], b = tets_.points[beyond] - tets_.points[at];
        angle += std::acos(std::clamp(a.dot(b) / (a.norm() * b.norm()), -1.0, 1.0));
        next = beyond;
      } while (next != it->first.second);
      spokes.back().quads_to_next = quads_in(angle);
    }
  }
  static int quads_in(double angle) { return std::max(1, static_cast<int>(std::lround(angle / (std::numbers::pi / 2)))); }

  // Quads from neighbour `from` of a mesh node counter-clockwise to its neighbour `to`.
  int quads_between(int node, int from, int to) const {
    int count = 0;
    const auto around = static_cast<int>(surface_.out[node].size());
    for (int n = from; n != to && count < around; ++count) {
      const Quad& q = b_.quads[surface_.left_of(node, n)];
      const auto k = std::find(q.begin(), q.end(), node) - q.begin();
      n = q[(k + 3) % 4];
    }
    return count;
  }

  // Price of edge `e` leaving its vertex towards `neighbour`, by the quads that come to lie between it and the edges there already: a narrow
  // angle of the CAD must not be shared by several.
  double spoke_price(int vertex, int e, int end, int node, int neighbour) const {
    const std::vector<Spoke>& spokes = spokes_[vertex];
    const int count = static_cast<int>(spokes.size());
    int self = -1;
    for (int i = 0; i < count; ++i) {
      if (spokes[i].edge == e && spokes[i].end == end) self = i;
    }
    if (self < 0) return 0;
    int wrong = 0, expected = 0;
    for (int i = 0; i + 1 < count; ++i) {
      expected += spokes[(self + i) % count].quads_to_next;
      const int step = step_of(spokes[(self + i + 1) % count]);
      if (step < 0) continue;
      wrong += std::abs(quads_between(node, neighbour, step) - expected);
      break;
    }
    expected = 0;
    for (int i = 0; i + 1 < count; ++i) {
      const Spoke& s = spokes[(self + count - 1 - i) % count];
      expected += s.quads_to_next;
      const int step = step_of(s);
      if (step < 0) continue;
      wrong += std::abs(quads_between(node, step, neighbour) - expected);
      break;
    }
    return kPadTuning.spoke_price * options_.size * std::min(wrong, 6);
  }

  // Vertices with lost edges that had no way to leave: fewer quads than edges between two captured edges there.
  std::vector<CrowdedCorner> crowded_corners() const {
    std::vector<CrowdedCorner> result;
    for (const int v : model_.vertices()) {
      const std::vector<Spoke>& spokes = spokes_[v];
      const int count = static_cast<int>(spokes.size()), node = vertex_node_[v];
      if (node < 0) continue;
      for (int i = 0; i < count; ++i) {
        const int from = step_of(spokes[i]);
        if (from < 0) continue;
        int lost = 0;
        while (lost + 1 < count && step_of(spokes[(i + lost + 1) % count]) < 0) ++lost;
        const int to = step_of(spokes[(i + lost + 1) % count]);
        const int quads = from == to ? static_cast<int>(surface_.out[node].size()) : quads_between(node, from, to);
        if (lost == 0 || quads > lost) continue;
        result.push_back({node, surface_.left_of(node, from)});
        break;
      }
    }
    return result;
  }

  // The node after that of the vertex on the spoke's path, -1 if it has none.
  int step_of(const Spoke& s) const {
    const auto& nodes = path_[s.edge].nodes;
    return nodes.size() < 2 ? -1 : s.end == 0 ? nodes[1] : nodes[nodes.size() - 2];
  }

  // Charts of the tet mesh's point that the mesh node lacks.
  std::ptrdiff_t missing_charts(int tet_node, int n) const {
    const std::vector<int>&wanted = tet_charts_[tet_node], &there = node_charts_[n];
    return std::count_if(wanted.begin(), wanted.end(), [&](int c) { return std::find(there.begin(), there.end(), c) == there.end(); });
  }

  // Nodes near CAD vertices.
  void find_places() {
    std::vector<char> wanted(model_.vertex_count() + 1, 0);
    for (int e : real_) {
      if (ignored(e)) continue;
      for (int v : model_.edge(e).vertices) wanted[v] = 1;
    }
    for (int v : tips_) wanted[v] = 1;
    std::vector<int> tet_node(model_.vertex_count() + 1, -1);
    for (int n = 0; n < static_cast<int>(tets_.points.size()); ++n) {
      if (tets_.point_cad[n].dim == 0) tet_node[tets_.point_cad[n].id] = n;
    }
    for (const int v : model_.vertices()) {
      if (!wanted[v] || tet_node[v] < 0) continue;
      const std::vector<int>& charts = tet_charts_[tet_node[v]];
      const Vec3 at = model_.vertex(v);
      for (int n : nodes_) {
        const double d = (b_.points[n] - at).norm() / options_.size;
        if (d > kPadTuning.reach) continue;
        // A vertex on a chart boundary or corner belongs on one of the mesh. The node of its image has its very place, and may lack a chart that is squeezed
        // to a line there.
        const bool image = d < kPadTuning.same_place;
        const auto missing = image ? 0 : missing_charts(tet_node[v], n);
        const auto surplus = static_cast<double>(node_charts_[n].size() + missing) - static_cast<double>(charts.size());
        places_.push_back({v, n, d + 2.0 * static_cast<double>(missing), surplus, 0.01 * static_cast<double>(charts.size())});
      }
    }
  }

  void place_vertices() {
    // An edge without a path may have begun at a node of a chart boundary, which other edges have to pass, though its vertex is off it.
    std::vector<int> failures(model_.vertex_count() + 1, 0);
    for (int e : real_) {
      for (int v : model_.edge(e).vertices) failures[v] = std::max(failures[v], failures_[e]);
    }
    struct Candidate {
      double cost;
      int vertex, node;
    };
    std::vector<Candidate> candidates;
    candidates.reserve(places_.size());
    for (const Place& p : places_) candidates.push_back({p.off + kPadTuning.surplus_price * failures[p.vertex] * p.surplus - p.bonus, p.vertex, p.node});
    std::sort(candidates.begin(), candidates.end(),
              [](const Candidate& a, const Candidate& b) { return std::tie(a.cost, a.vertex, a.node) < std::tie(b.cost, b.vertex, b.node); });
    vertex_node_.assign(model_.vertex_count() + 1, -1);
    owner_.assign(b_.points.size(), 0);
    for (const auto& [e, nodes] : options_.given_paths) {
      for (const auto& [v, n] : {std::pair(model_.edge(e).vertices[0], nodes.front()), std::pair(model_.edge(e).vertices[1], nodes.back())}) {
        vertex_node_[v] = n;
        owner_[n] = -v;
      }
    }
    for (const Candidate& c : candidates) {
      if (vertex_node_[c.vertex] >= 0 || owner_[c.node] != 0) continue;
      vertex_node_[c.vertex] = c.node;
      owner_[c.node] = -c.vertex;
    }
  }

  // Pairs of charts that the CAD edge runs between, and charts that it runs inside of.
  std::set<std::pair<int, int>> chart_pairs(const std::vector<int>& chain) const {
    std::set<std::pair<int, int>> pairs;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) pairs.insert(pair_of(chain[i], chain[i + 1]));
    return pairs;
  }
  std::pair<int, int> pair_of(int a, int b) const {
    const int p = triangle_chart(triangle_left_.at(key(a, b))), q = triangle_chart(triangle_left_.at(key(b, a)));
    return std::minmax(p, q);
  }
  std::pair<int, int> charts_beside(int half) const {
    const int p = b_.quad_chart[half / 4], q = b_.quad_chart[surface_.right_of(half)];
    return std::minmax(p, q);
  }
  int triangle_chart(int t) const { return chart_of_triangle_[t]; }

  void route_all() {
    path_.assign(model_.edge_count() + 1, {});
    taken_.clear();
    std::vector<int> order;
    std::map<int, double> inside;  // share of the edge that runs inside charts: those with none first, they have no choice
    for (int e : real_) {
      if (lost_[e]) continue;
      const auto& chain = options_.edge_chains[e];
      int n = 0;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const auto p = pair_of(chain[i], chain[i + 1]);
        n += p.first == p.second;
      }
      inside[e] = static_cast<double>(n) / static_cast<double>(chain.size() - 1);
      order.push_back(e);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      if (options_.given_paths.contains(a) != options_.given_paths.contains(b)) return options_.given_paths.contains(a);
      if (failures_[a] != failures_[b]) return failures_[a] > failures_[b];
      if (inside[a] != inside[b]) return inside[a] < inside[b];
      return model_.edge(a).length > model_.edge(b).length * (1 + 1e-9);
    });
    for (int e : order) {
      monitor_.check();
      if (!route(e)) lost_[e] = 1;
    }
  }

  bool route(int e) {
    const auto& chain = options_.edge_chains[e];
    const int from = vertex_node_[model_.edge(e).vertices[0]], to = vertex_node_[model_.edge(e).vertices[1]];
    if (from < 0 || to < 0) return false;
    std::vector<int> stops{from, to};
    std::vector<std::pair<std::size_t, std::size_t>> pieces{{0, chain.size() - 1}};
    if (from == to) {
      if (chain.front() != chain.back()) return false;
      // A closed edge goes through two more nodes, a third of its length apart.
      const std::size_t n = chain.size() - 1;
      const int p = near_node(chain[n / 3], {from}), q = p < 0 ? -1 : near_node(chain[2 * n / 3], {from, p});
      if (p < 0 || q < 0) return false;
      stops = {from, p, q, from};
      pieces = {{0, n / 3}, {n / 3, 2 * n / 3}, {2 * n / 3, n}};
    }
    Path path;
    path.nodes = {from};
    double sum = 0;
    std::vector<int> taken;
    bool ok = true;
    if (const auto given = options_.given_paths.find(e); given != options_.given_paths.end()) {
      path.nodes = given->second;
      stops.clear();
      for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i) {
        ok = ok && owner_[path.nodes[i]] == 0;
        if (owner_[path.nodes[i]] == 0) taken.push_back(path.nodes[i]);
      }
      for (const int n : taken) owner_[n] = e;
    }
    for (std::size_t i = 0; i + 1 < stops.size() && ok; ++i) {
      std::vector<int> piece(chain.begin() + static_cast<std::ptrdiff_t>(pieces[i].first), chain.begin() + static_cast<std::ptrdiff_t>(pieces[i].second) + 1);
      const std::vector<int> nodes = shortest(piece, stops[i], stops[i + 1], e, i == 0, i + 2 == stops.size(), sum);
      ok = nodes.size() > 1;
      if (!ok) break;
      path.nodes.insert(path.nodes.end(), nodes.begin() + 1, nodes.end());
      for (int n : nodes) {
        if (owner_[n] == 0) {
          owner_[n] = e;
          taken.push_back(n);
        }
      }
    }
    std::set<int> unique(path.nodes.begin(), path.nodes.end());
    ok = ok && unique.size() + (from == to ? 1 : 0) == path.nodes.size();
    if (!ok) {
      for (int n : taken) owner_[n] = 0;
      return false;
    }
    path.deviation = sum / static_cast<double>(path.nodes.size());
    const auto pairs = chart_pairs(chain);
    for (std::size_t i = 0; i + 1 < path.nodes.size(); ++i) {
      path.astray += pairs.count(charts_beside(surface_.half(path.nodes[i], path.nodes[i + 1]))) == 0;
    }
    path.astray /= static_cast<double>(path.nodes.size() - 1);
    for (std::size_t i = 0; i + 1 < path.nodes.size(); ++i) taken_.insert(std::minmax(path.nodes[i], path.nodes[i + 1]));
    path_[e] = std::move(path);
    return true;
  }

  int near_node(int tet_node, const std::vector<int>& not_these) const {
    int best = -1;
    double best_cost = kNever;
    for (int n : nodes_) {
      if (owner_[n] != 0 || std::find(not_these.begin(), not_these.end(), n) != not_these.end()) continue;
      const double d = (b_.points[n] - tets_.points[tet_node]).norm() / options_.size;
      if (d >= best_cost) continue;
      const double cost = d + 2.0 * static_cast<double>(missing_charts(tet_node, n));
      if (cost < best_cost) {
        best_cost = cost;
        best = n;
      }
    }
    return best_cost < kPadTuning.reach ? best : -1;
  }

  // Price of the angle between two path edges at a node inside the grid: one quad on a side would become a flat corner.
  double turn_price(int a, int b, int c) const {
    if (surface_.out[b].size() != 4 || node_charts_[b].size() != 1) return 0;
    const int q1 = surface_.left_of(b, c), q2 = surface_.left_of(c, b);
    const auto has = [&](int q) { return std::find(b_.quads[q].begin(), b_.quads[q].end(), a) != b_.quads[q].end(); };
    return has(q1) || has(q2) ? 0.5 * options_.size : 0;
  }

  // Dijkstra over directed boundary edges, cheap near the chain. `first`, `last`: `from`, `to` is the vertex where edge `e` begins, ends.
  std::vector<int> shortest(const std::vector<int>& chain, int from, int to, int e, bool first, bool last, double& deviation) {
    const auto pairs = chart_pairs(chain);
    ++search_;
    const auto away = [&](int n) {
      if (off_of_[n] == search_) return off_[n];
      double d = kNever;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) d = std::min(d, distance_to_segment(b_.points[n], tets_.points[chain[i]], tets_.points[chain[i + 1]]));
      off_of_[n] = search_;
      off_[n] = d;
      return d;
    };
    struct Item {
      double cost;
      int a, b, half;
      bool operator>(const Item& o) const { return std::tie(cost, a, b) > std::tie(o.cost, o.a, o.b); }
    };
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    const auto push = [&](double base, int previous, int a, int b, int half) {
      if ((b != to && owner_[b] != 0) || (b == to && taken_.count(std::minmax(a, b)) > 0)) return;
      const double da = away(a), db = away(b), size = options_.size;
      if (db > kPadTuning.reach * size && b != to) return;
      double cost = (b_.points[a] - b_.points[b]).norm() + 1e-3 * size;
      const double mean = (da + db) / (2 * size);
      cost *= 1 + 8 * mean + 16 * mean * mean;
      if (pairs.count(charts_beside(half)) == 0) cost = 6 * cost + size;
      if (previous >= 0) cost += turn_price(previous, a, b);
      if (previous < 0 && first) cost += spoke_price(model_.edge(e).vertices[0], e, 0, from, b);
      if (b == to && last) cost += spoke_price(model_.edge(e).vertices[1], e, 1, to, a);
      if (best_of_[half] == search_ && best_[half] <= base + cost) return;
      best_of_[half] = search_;
      best_[half] = base + cost;
      before_[half] = previous;
      queue.push({base + cost, a, b, half});
    };
    for (std::size_t i = 0; i < surface_.out[from].size(); ++i) push(0, -1, from, surface_.out[from][i], surface_.halves[from][i]);
    while (!queue.empty()) {
      const Item item = queue.top();
      queue.pop();
      if (item.cost > best_[item.half]) continue;
      if (item.b == to) {
        std::vector<int> nodes{item.b};
        int a = item.a, b = item.b;
        while (a >= 0) {
          nodes.push_back(a);
          const int p = before_[surface_.half(a, b)];
          b = a;
          a = p;
        }
        std::reverse(nodes.begin(), nodes.end());
        for (int n : nodes) deviation += away(n);
        return nodes;
      }
      for (std::size_t i = 0; i < surface_.out[item.b].size(); ++i) {
        const int n = surface_.out[item.b][i];
        if (n != item.a) push(item.cost, item.a, item.b, n, surface_.halves[item.b][i]);
      }
    }
    return {};
  }

  // Cuts the quads along the paths and compares the regions with the patches. 0: they agree and `result` is filled; > 0: an edge to give up;
  // -1: disagreement without any edge left.
  int regions(Association& result) {
    std::vector<int> group(model_.face_count() + 1);
    std::iota(group.begin(), group.end(), 0);
    const auto find = [&](int f) {
      while (group[f] != f) f = group[f];
      return f;
    };
    for (int e : real_) {
      if (!lost_[e]) continue;
      const int a = find(model_.edge(e).faces[0]), b = find(model_.edge(e).faces[1]);
      group[std::max(a, b)] = std::min(a, b);
    }
    std::vector<int> cut(surface_.twin.size(), 0);  // per half edge on a path: CAD face that belongs on its left, 0 for others
    std::vector<int> cut_edge(surface_.twin.size(), 0);
    for (int e : real_) {
      if (lost_[e]) continue;
      const auto& chain = options_.edge_chains[e];
      const int left = tets_.triangle_face[triangle_left_.at(key(chain[0], chain[1]))], right = tets_.triangle_face[triangle_left_.at(key(chain[1], chain[0]))];
      for (std::size_t i = 0; i + 1 < path_[e].nodes.size(); ++i) {
        const int there = surface_.half(path_[e].nodes[i], path_[e].nodes[i + 1]), back = surface_.half(path_[e].nodes[i + 1], path_[e].nodes[i]);
        cut[there] = left;
        cut[back] = right;
        cut_edge[there] = cut_edge[back] = e;
      }
    }
    const int n = static_cast<int>(b_.quads.size());
    std::vector<int> region(n, -1);
    std::map<int, int> patch_region;  // representative face -> region
    std::vector<std::vector<int>> members;
    std::vector<int> region_patch;
    int culprit = 0;
    double culprit_cost = -1;
    const auto blame = [&](int e) {
      const double cost = path_[e].deviation / options_.size + kPadTuning.astray_blame * path_[e].astray + 1e-6 * e;
      if (cost > culprit_cost) {
        culprit_cost = cost;
        culprit = e;
      }
    };
    for (int seed = 0; seed < n; ++seed) {
      if (region[seed] >= 0) continue;
      const int id = static_cast<int>(members.size());
      members.push_back({seed});
      region[seed] = id;
      std::map<int, std::set<int>> faces;  // patch -> edges that say so
      for (std::size_t i = 0; i < members[id].size(); ++i) {
        const int q = members[id][i];
        for (int h = 4 * q; h < 4 * q + 4; ++h) {
          if (cut[h] != 0) {
            faces[find(cut[h])].insert(cut_edge[h]);
            continue;
          }
          const int m = surface_.right_of(h);
          if (region[m] >= 0) continue;
          region[m] = id;
          members[id].push_back(m);
        }
      }
      int patch = -1;
      if (faces.empty()) {
        std::map<int, int> votes;
        for (const int q : members[id]) ++votes[find(tets_.triangle_face[b_.quad_triangle[q]])];
        patch = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
      } else if (faces.size() == 1) {
        patch = faces.begin()->first;
      } else {
        for (const auto& [f, edges] : faces) {
          for (int e : edges) blame(e);
        }
      }
      region_patch.push_back(patch);
      if (patch >= 0 && !patch_region.try_emplace(patch, id).second) {
        for (const auto& [f, edges] : faces) {
          for (int e : edges) blame(e);
        }
      }
    }
    if (culprit == 0) {
      // Every patch must have its region, with the Euler characteristic of its triangles.
      std::map<int, int> expected = tet_euler(find);
      for (const auto& [patch, chi] : expected) {
        const auto it = patch_region.find(patch);
        const bool same = it != patch_region.end() && quad_euler(members[it->second]) == chi;
        if (same) continue;
        for (int e : real_) {
          if (!lost_[e] && (find(model_.edge(e).faces[0]) == patch || find(model_.edge(e).faces[1]) == patch)) blame(e);
        }
        if (culprit == 0) return -1;
      }
    }
    if (culprit != 0) return culprit;
    fill(result, region, region_patch, find);
    return 0;
  }

  int quad_euler(const std::vector<int>& quads) const {
    std::vector<char> node(b_.points.size(), 0), side(surface_.twin.size(), 0);
    int chi = static_cast<int>(quads.size());
    for (const int q : quads) {
      for (int k = 0; k < 4; ++k) {
        const int h = 4 * q + k;
        chi += !std::exchange(node[b_.quads[q][k]], 1);
        chi -= !std::exchange(side[std::max(h, surface_.twin[h])], 1);
      }
    }
    return chi;
  }
  std::map<int, int> tet_euler(const std::function<int(int)>& find) const {
    std::map<int, std::vector<int>> patches;
    for (const int f : model_.faces()) {
      if (!face_triangles_[f].empty()) patches[find(f)].push_back(f);
    }
    std::map<int, int> result;
    std::vector<int> node(tets_.points.size(), 0), side(static_cast<std::size_t>(sides_), 0);  // the last patch that had it
    for (const auto& [patch, faces] : patches) {
      int chi = 0;
      for (const int f : faces) {
        for (const int t : face_triangles_[f]) {
          ++chi;
          for (int k = 0; k < 3; ++k) {
            chi += std::exchange(node[tets_.triangles[t][k]], patch) != patch;
            chi -= std::exchange(side[triangle_sides_[t][k]], patch) != patch;
          }
        }
      }
      result[patch] = chi;
    }
    return result;
  }

  void fill(Association& result, const std::vector<int>& region, const std::vector<int>& region_patch, const std::function<int(int)>& find) const {
    std::map<int, int> index;
    for (const int f : model_.faces()) {
      const auto [it, fresh] = index.try_emplace(find(f), static_cast<int>(index.size()));
      if (fresh) result.patches.emplace_back();
      result.patches[it->second].push_back(f);
    }
    result.quads = b_.quads;
    result.quad_patch.resize(b_.quads.size());
    result.point_cad.assign(b_.points.size(), CadRef{3, 1});
    for (std::size_t q = 0; q < b_.quads.size(); ++q) {
      result.quad_patch[q] = index.at(region_patch[region[q]]);
      for (int n : b_.quads[q]) result.point_cad[n] = {2, result.quad_patch[q]};
    }
    std::vector<char> reached(model_.vertex_count() + 1, 0), wanted(model_.vertex_count() + 1, 0);
    for (int e : real_) {
      for (int v : model_.edge(e).vertices) wanted[v] = std::max<char>(wanted[v], ignored(e) ? kIgnored : kWanted);
      if (lost_[e]) {
        (ignored(e) ? result.ignored_edges : result.lost_edges).push_back(e);
        continue;
      }
      for (int v : model_.edge(e).vertices) reached[v] = 1;
      const auto& nodes = path_[e].nodes;
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        result.segments.push_back({nodes[i], nodes[i + 1]});
        result.segment_edge.push_back(e);
        result.point_cad[nodes[i + 1]] = {1, e};
      }
    }
    for (int v : tips_) {
      wanted[v] = kWanted;
      reached[v] = vertex_node_[v] >= 0;
    }
    for (const int v : model_.vertices()) {
      if (!wanted[v]) continue;
      if (reached[v]) {
        result.point_cad[vertex_node_[v]] = {0, v};
      } else {
        (wanted[v] == kIgnored ? result.ignored_vertices : result.lost_vertices).push_back(v);
      }
    }
    note_ignored_faces(result);
  }

  // Patches whose faces ignored edges alone join.
  void note_ignored_faces(Association& result) const {
    std::vector<int> group(model_.face_count() + 1);
    std::iota(group.begin(), group.end(), 0);
    for (int e : result.ignored_edges) {
      const int a = group[model_.edge(e).faces[0]], b = group[model_.edge(e).faces[1]];
      std::replace(group.begin(), group.end(), std::max(a, b), std::min(a, b));
    }
    for (const auto& patch : result.patches) {
      const bool one = std::all_of(patch.begin(), patch.end(), [&](int f) { return group[f] == group[patch[0]]; });
      if (patch.size() > 1 && one) result.ignored_faces.insert(result.ignored_faces.end(), patch.begin(), patch.end());
    }
  }

  bool ignored(int e) const { return !options_.ignored.empty() && options_.ignored[e]; }

  static constexpr char kIgnored = 1, kWanted = 2;  // of a vertex: on ignored edges only; on others
  const CadModel& model_;
  const TetMesh& tets_;
  const HexBoundary& b_;
  const AssociateOptions& options_;
  const Monitor& monitor_;
  Surface surface_;
  std::vector<int> nodes_;                     // boundary nodes
  std::vector<std::vector<int>> node_charts_;  // per mesh node, ascending
  std::vector<std::vector<int>> tet_charts_;   // per tet mesh point, ascending
  std::vector<int> chart_of_triangle_;
  std::unordered_map<std::uint64_t, int> triangle_left_;
  std::vector<std::vector<int>> face_triangles_;    // per CAD face
  std::vector<std::array<int, 3>> triangle_sides_;  // numbers of the triangle's edges
  int sides_ = 0;                                   // how many edges the triangles have
  // A node where a CAD vertex may be placed: what that costs, and charts that the node has and the vertex has not.
  struct Place {
    int vertex, node;
    double off, surplus, bonus;
  };
  std::vector<Place> places_;
  // Of the search for a path: what was found in an earlier one does not count.
  int search_ = 0;
  std::vector<double> off_;   // per node: distance from the chain
  std::vector<int> off_of_;   // the search that it is from
  std::vector<double> best_;  // per half edge: cost up to its end
  std::vector<int> before_;   // the node before it
  std::vector<int> best_of_;  // the search that these are from
  std::vector<int> real_;     // CAD edges that count
  std::vector<int> tips_;     // CAD vertices without such edges that count all the same
  std::vector<char> lost_;
  std::vector<int> vertex_node_;
  std::vector<int> owner_;  // per mesh node: 0 free, -v vertex, e edge
  std::vector<Path> path_;
  std::set<std::pair<int, int>> taken_;     // mesh edges on paths: two may join the same vertices
  std::vector<std::vector<Spoke>> spokes_;  // per CAD vertex, counter-clockwise
  std::vector<int> failures_;               // per CAD edge: rounds without a path
};

}  // namespace

Association associate(const CadModel& model, const TetMesh& tets, const std::vector<Chart>& charts, const HexBoundary& boundary,
                      const AssociateOptions& options, const Monitor& monitor, std::vector<CrowdedCorner>* crowded) {
  return Associator(model, tets, charts, boundary, options, monitor).run(crowded);
}

}  // namespace polycube
