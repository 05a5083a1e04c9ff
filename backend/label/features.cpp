#include "label/features.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

#include "core/charts.h"
#include "label/tuning.h"

namespace polycube {
namespace {

class Groups {
 public:
  explicit Groups(int n) : parent_(n), chart_(n, -1) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  /// False when that would put two different charts on one plane and they must not be `joined`; the groups may then be half united.
  bool unite(int a, int b, bool joined = false) {
    a = find(a);
    b = find(b);
    if (a == b) return true;
    if (a > b) std::swap(a, b);
    if (chart_[a] >= 0 && chart_[b] >= 0 && !joined) return false;
    parent_[b] = a;
    if (chart_[a] < 0) chart_[a] = chart_[b];
    return true;
  }
  void set_chart(int i, int chart) { chart_[find(i)] = chart; }

 private:
  std::vector<int> parent_;
  std::vector<int> chart_;
};

struct Run {
  int axis;
  std::vector<int> nodes;
};

class Finder {
 public:
  Finder(const CadModel& model, const TetMesh& mesh, const Labelling& labelling)
      : model_(model), mesh_(mesh), labels_(labelling.label), frame_(labelling.frame) {
    const int n = static_cast<int>(mesh.points.size());
    groups_.assign(3, Groups(n));
    const std::vector<Chart> charts = find_charts(mesh.triangles, labels_);
    for (int c = 0; c < static_cast<int>(charts.size()); ++c) {
      Groups& g = groups_[charts[c].axis];
      for (int node : charts[c].nodes) g.unite(charts[c].nodes.front(), node);
      g.set_chart(charts[c].nodes.front(), c);
    }
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
        sides_[{std::min(a, b), std::max(a, b)}].push_back(t);
        at_[a].push_back(t);
      }
    }
  }

  FeatureEdge add(int edge, const std::vector<int>& chain, std::vector<FeatureChart>& charts) {
    FeatureEdge result{edge, EdgeCapture::kBoundary, {}};
    const std::vector<Run> runs = find_runs(edge, chain);
    if (runs.empty()) return result;
    std::vector<Groups> trial = groups_;
    for (const Run& run : runs) {
      const bool level = is_level(run);
      for (int node : run.nodes) {
        if (trial[run.axis].unite(run.nodes.front(), node, level)) continue;
        return {edge, EdgeCapture::kLost, "its two ends lie on different charts of one axis"};
      }
    }
    if (flattens(trial, runs)) return {edge, EdgeCapture::kLost, "a face beside it would be squeezed flat"};
    groups_ = std::move(trial);
    for (const Run& run : runs) {
      Chart c;
      c.axis = run.axis;
      c.nodes = run.nodes;
      std::sort(c.nodes.begin(), c.nodes.end());
      c.nodes.erase(std::unique(c.nodes.begin(), c.nodes.end()), c.nodes.end());
      charts.push_back({edge, std::move(c)});
    }
    result.capture = EdgeCapture::kFeature;
    return result;
  }

 private:
  // Constant axis of each segment (-1 on a chart boundary), by dynamic programming along the chain; then the maximal pieces.
  std::vector<Run> find_runs(int edge, const std::vector<int>& chain) const {
    const std::size_t n = chain.size() - 1;
    constexpr double kNever = std::numeric_limits<double>::infinity();
    std::vector<std::array<double, 4>> cost(n, {kNever, kNever, kNever, kNever});  // 3: chart boundary
    for (std::size_t i = 0; i < n; ++i) {
      const auto& beside = sides_.at(std::minmax(chain[i], chain[i + 1]));
      const int p = labels_[beside[0]], q = labels_[beside[1]];
      if (p != q) {
        cost[i][3] = 0;
        continue;
      }
      Vec3 d = frame_ * (mesh_.points[chain[i + 1]] - mesh_.points[chain[i]]);
      const double length = d.norm();
      d[label_axis(p)] = 0;
      const double across = std::max(d.squaredNorm(), 1e-300);
      for (int k = 0; k < 3; ++k) {
        if (k != label_axis(p)) cost[i][k] = length * d[k] * d[k] / across;
      }
    }
    const double turn = kLabelTuning.turn_price * model_.edge(edge).length;
    const auto change = [&](int a, int b) { return a == b || a == 3 || b == 3 ? 0.0 : turn; };
    // A closed edge is walked twice round; the choices of the second half of the first round and the first half of the second are the cyclic ones.
    const bool closed = chain.front() == chain.back();
    const std::size_t steps = closed ? 2 * n : n;
    std::vector<std::array<int, 4>> from(steps);
    std::array<double, 4> best = cost[0];
    for (std::size_t i = 1; i < steps; ++i) {
      std::array<double, 4> next{kNever, kNever, kNever, kNever};
      for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) {
          const double c = best[a] + change(a, b) + cost[i % n][b];
          if (c < next[b]) {
            next[b] = c;
            from[i][b] = a;
          }
        }
      }
      best = next;
    }
    std::vector<int> choice(n);
    int at = static_cast<int>(std::min_element(best.begin(), best.end()) - best.begin());
    for (std::size_t i = steps; i-- > 0;) {
      if (!closed || (i >= n / 2 && i < n / 2 + n)) choice[i % n] = at;
      at = from[i][at];
    }
    std::size_t start = 0;
    if (closed) {
      while (start < n && choice[start] == choice[(start + n - 1) % n]) ++start;
      if (start == n) start = 0;
    }
    std::vector<Run> runs;
    for (std::size_t s = 0; s < n; ++s) {
      const std::size_t i = (start + s) % n;
      if (choice[i] == 3) continue;
      const bool goes_on = !runs.empty() && s > 0 && choice[(i + n - 1) % n] == choice[i];
      if (!goes_on) runs.push_back({choice[i], {chain[i]}});
      runs.back().nodes.push_back(chain[i + 1]);
    }
    return runs;
  }

  // Is the axis really constant along the run? Charts at its two ends then stand level on the part and may do so in the image.
  bool is_level(const Run& run) const {
    Vec3 low = frame_ * mesh_.points[run.nodes.front()], high = low;
    for (int node : run.nodes) {
      low = low.cwiseMin(frame_ * mesh_.points[node]);
      high = high.cwiseMax(frame_ * mesh_.points[node]);
    }
    return (high - low)[run.axis] <= kLabelTuning.level * (high - low).norm();
  }

  // Would some triangle at the runs' nodes have no area in the image?
  bool flattens(const std::vector<Groups>& groups, const std::vector<Run>& runs) const {
    for (const Run& run : runs) {
      for (int node : run.nodes) {
        for (int t : at_.at(node)) {
          const Triangle& tri = mesh_.triangles[t];
          for (int d = 0; d < 3; ++d) {
            if (d == label_axis(labels_[t])) continue;
            if (groups[d].find(tri[0]) == groups[d].find(tri[1]) && groups[d].find(tri[1]) == groups[d].find(tri[2])) return true;
          }
          // Two points of a triangle that agree in all axes are one point.
          for (int k = 0; k < 3; ++k) {
            bool same = true;
            for (int d = 0; d < 3; ++d) same = same && groups[d].find(tri[k]) == groups[d].find(tri[(k + 1) % 3]);
            if (same) return true;
          }
        }
      }
    }
    return false;
  }

  const CadModel& model_;
  const TetMesh& mesh_;
  const std::vector<int>& labels_;
  Mat3 frame_;
  std::vector<Groups> groups_;
  std::map<std::pair<int, int>, std::vector<int>> sides_;
  std::map<int, std::vector<int>> at_;
};

// Does the edge begin at the vertex, or at one that a tiny edge joins to it?
bool is_end(const CadModel& model, int edge, int vertex) {
  return vertex == model.edge(edge).vertices[0] || (model.vertex(vertex) - model.edge_point(edge, model.edge_range(edge)[0])).norm() <= 1e-5 * model.diagonal();
}

// A chain that begins and ends at one vertex, though not at one node: goes back to its start along the tiny edges that make one vertex of two. `beside`: the
// nodes next to each on tiny edges.
void close_by_tiny_edges(std::vector<int>& chain, const std::map<int, std::vector<int>>& beside) {
  const int start = chain.front(), end = chain.back();
  std::map<int, int> back{{start, start}};
  std::vector<int> queue{start};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto found = beside.find(queue[i]);
    if (found == beside.end()) continue;
    for (const int n : found->second) {
      if (back.try_emplace(n, queue[i]).second) queue.push_back(n);
    }
  }
  if (!back.contains(end)) return;
  for (int n = end; n != start; chain.push_back(n)) n = back[n];
}

}  // namespace

std::vector<std::vector<int>> edge_chains(const CadModel& model, const TetMesh& mesh) {
  std::vector<std::map<int, std::vector<int>>> next(model.edge_count() + 1);
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    const auto [a, b] = mesh.segments[i];
    next[mesh.segment_edge[i]][a].push_back(b);
    next[mesh.segment_edge[i]][b].push_back(a);
  }
  std::map<int, std::vector<int>> beside_tiny;
  for (std::size_t i = 0; i < mesh.segments.size(); ++i) {
    const auto [a, b] = mesh.segments[i];
    if (!model.edge(mesh.segment_edge[i]).tiny) continue;
    beside_tiny[a].push_back(b);
    beside_tiny[b].push_back(a);
  }
  std::vector<std::vector<int>> chains(model.edge_count() + 1);
  for (const int e : model.edges()) {
    if (next[e].empty()) continue;
    int start = next[e].begin()->first;
    for (const auto& [node, beside] : next[e]) {
      const bool end = mesh.point_cad[node].dim == 0 && is_end(model, e, mesh.point_cad[node].id);
      if (end) start = node;
    }
    std::vector<int>& chain = chains[e];
    chain = {start};
    int previous = -1, at = start;
    do {
      const auto& beside = next[e][at];
      const int to = beside.size() > 1 && beside[0] == previous ? beside[1] : beside[0];
      if (to == previous) break;
      previous = at;
      at = to;
      chain.push_back(at);
    } while (at != start && next[e][at].size() > 1);
    if (!model.edge(e).tiny && model.edge(e).vertices[0] == model.edge(e).vertices[1] && at != start) close_by_tiny_edges(chain, beside_tiny);
  }
  return chains;
}

double bend(const CadEdge& edge) { return std::max(std::abs(edge.min_angle - std::numbers::pi), std::abs(edge.max_angle - std::numbers::pi)); }

std::vector<char> smooth_edges(const CadModel& model, double angle, const std::vector<int>& keep_faces) {
  const auto kept = [&](int face) { return std::find(keep_faces.begin(), keep_faces.end(), face) != keep_faces.end(); };
  std::vector<char> smooth(static_cast<std::size_t>(model.edge_count()) + 1, 0);
  for (const int e : model.edges()) {
    const CadEdge& edge = model.edge(e);
    smooth[e] = bend(edge) < angle && !kept(edge.faces[0]) && !kept(edge.faces[1]);
  }
  return smooth;
}

Features find_features(const CadModel& model, const TetMesh& mesh, const Labelling& labelling, const std::vector<char>& left_out, const Monitor& monitor) {
  const auto chains = edge_chains(model, mesh);
  std::vector<int> order;
  for (const int e : model.edges()) {
    if (!model.edge(e).seam && !model.edge(e).degenerate && !model.edge(e).tiny) order.push_back(e);
  }
  // Sharp edges first, then long ones: where two exclude each other the one that matters more stays.
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const bool sharp_a = bend(model.edge(a)) > std::numbers::pi / 6, sharp_b = bend(model.edge(b)) > std::numbers::pi / 6;
    if (sharp_a != sharp_b) return sharp_a;
    return model.edge(a).length > model.edge(b).length * (1 + 1e-9);
  });
  Finder finder(model, mesh, labelling);
  Features features;
  for (int e : order) {
    monitor.check();
    if (chains[e].size() < 2) {
      features.edges.push_back({e, EdgeCapture::kLost, "the tet mesh has no nodes on it"});
    } else if (left_out[e]) {
      features.edges.push_back({e, EdgeCapture::kLost, "smooth, below the feature angle"});
    } else {
      features.edges.push_back(finder.add(e, chains[e], features.charts));
    }
  }
  return features;
}

}  // namespace polycube
