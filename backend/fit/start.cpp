#include "fit/start.h"

#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "core/hexahedron.h"
#include "fit/tuning.h"

namespace polycube {

namespace {

// Arc length along a CAD edge and the angle its tangent has turned by, from samples.
class ArcLength {
 public:
  ArcLength(const CadModel& model, int edge) : range_(model.edge_range(edge)) {
    const auto points = model.edge_samples(edge, kFitTuning.samples);
    lengths_.assign(kFitTuning.samples, 0);
    for (int i = 1; i < kFitTuning.samples; ++i) lengths_[i] = lengths_[i - 1] + (points[i] - points[i - 1]).norm();
    turned_.assign(kFitTuning.samples, 0);
    Vec3 before = tangent(model, edge, 0);
    for (int i = 1; i < kFitTuning.samples; ++i) {
      const Vec3 now = tangent(model, edge, i);
      turned_[i] = turned_[i - 1] + std::atan2(before.cross(now).norm(), before.dot(now));
      before = now;
    }
  }
  double total() const { return lengths_.back(); }
  double total_turn() const { return turned_.back(); }
  double length(double t) const { return at(lengths_, t); }
  double turned(double t) const { return at(turned_, t); }
  // Radians per mm.
  double curvature(double t) const {
    const int i = std::min(static_cast<int>(place(t)), kFitTuning.samples - 2);
    const double length = lengths_[i + 1] - lengths_[i];
    return length > 0 ? (turned_[i + 1] - turned_[i]) / length : 0;
  }
  double parameter(double length) const {
    const auto it = std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, length);
    const int i = static_cast<int>(it - lengths_.begin()) - 1;
    const double span = lengths_[i + 1] - lengths_[i];
    const double x = i + (span > 0 ? (length - lengths_[i]) / span : 0);
    return range_[0] + x / (kFitTuning.samples - 1) * (range_[1] - range_[0]);
  }

 private:
  Vec3 tangent(const CadModel& model, int edge, int i) const {
    return model.edge_tangent(edge, range_[0] + i * (range_[1] - range_[0]) / (kFitTuning.samples - 1));
  }
  double place(double t) const { return std::clamp((t - range_[0]) / (range_[1] - range_[0]), 0.0, 1.0) * (kFitTuning.samples - 1); }
  double at(const std::vector<double>& values, double t) const {
    const double x = place(t);
    const int i = std::min(static_cast<int>(x), kFitTuning.samples - 2);
    return values[i] + (x - i) * (values[i + 1] - values[i]);
  }
  std::array<double, 2> range_;
  std::vector<double> lengths_, turned_;
};

struct NodeChain {
  int edge = 0;
  std::vector<int> nodes;  // in order; the first again at the end of a loop without vertex
};

// The segments of each CAD edge joined to chains, from vertex to vertex.
std::vector<NodeChain> find_chains(const Association& association) {
  std::vector<std::array<int, 3>> halves;  // edge, node, other node
  for (std::size_t s = 0; s < association.segments.size(); ++s) {
    const auto [a, b] = association.segments[s];
    halves.push_back({association.segment_edge[s], a, b});
    halves.push_back({association.segment_edge[s], b, a});
  }
  std::sort(halves.begin(), halves.end());
  std::vector<char> used(halves.size(), 0);
  const auto take = [&](int edge, int node) {
    auto it = std::lower_bound(halves.begin(), halves.end(), std::array{edge, node, -1});
    for (; it != halves.end() && (*it)[0] == edge && (*it)[1] == node; ++it) {
      if (used[it - halves.begin()]) continue;
      used[it - halves.begin()] = 1;
      const auto back = std::lower_bound(halves.begin(), halves.end(), std::array{edge, (*it)[2], node});
      used[back - halves.begin()] = 1;
      return (*it)[2];
    }
    return -1;
  };
  std::vector<NodeChain> chains;
  for (const bool loops : {false, true}) {
    for (std::size_t i = 0; i < halves.size(); ++i) {
      const auto [edge, node, other] = halves[i];
      if (used[i] || (!loops && association.point_cad[node].dim != 0)) continue;
      NodeChain chain{edge, {node}};
      for (int next = take(edge, node); next >= 0;) {
        chain.nodes.push_back(next);
        const bool ended = loops ? next == node : association.point_cad[next].dim == 0;
        next = ended ? -1 : take(edge, next);
      }
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

// Lengths along the curve for the nodes of a chain, by the places where they are.
std::vector<double> spread(const std::vector<double>& gaps, double from, double to) {
  double total = 0, least = 0;
  for (double g : gaps) total += g;
  least = 0.4 * total / static_cast<double>(gaps.size());
  double sum = 0;
  for (double g : gaps) sum += std::max(g, least);
  std::vector<double> lengths{from};
  for (double g : gaps) lengths.push_back(lengths.back() + (sum > 0 ? std::max(g, least) / sum : 1.0 / static_cast<double>(gaps.size())) * (to - from));
  lengths.back() = to;
  return lengths;
}

// Solves for the nodes of `dimension` so that each moves by the mean of its neighbours' displacements; others have moved already.
void follow(std::vector<Vec3>& points, const std::vector<Vec3>& before, const std::vector<Segment>& edges, const std::vector<char>& free) {
  std::vector<int> unknown(points.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (free[v]) unknown[v] = count++;
  }
  if (count == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> degree(count, 0);
  Eigen::MatrixX3d rhs = Eigen::MatrixX3d::Zero(count, 3);
  for (const auto& [a, b] : edges) {
    for (const auto& [v, w] : {Segment{a, b}, Segment{b, a}}) {
      if (unknown[v] < 0) continue;
      degree[unknown[v]] += 1;
      if (unknown[w] >= 0) {
        entries.emplace_back(unknown[v], unknown[w], -1.0);
      } else {
        rhs.row(unknown[v]) += (points[w] - before[w]).transpose();
      }
    }
  }
  // The shift keeps parts without any moved neighbour where they are.
  for (int i = 0; i < count; ++i) entries.emplace_back(i, i, degree[i] + 1e-6);
  if (rhs.squaredNorm() == 0) return;
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(1e-3);
  solver.setMaxIterations(200);
  solver.compute(matrix);
  const Eigen::MatrixX3d moved = solver.solve(rhs);
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (unknown[v] >= 0) points[v] += moved.row(unknown[v]).transpose();
  }
}

std::vector<Segment> unique_edges(std::vector<Segment> edges) {
  for (auto& e : edges) std::sort(e.begin(), e.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void place_chain(const CadModel& model, const NodeChain& chain, const ArcLength& arc, std::vector<Vec3>& points, Entities& entities) {
  const CadEdge& edge = model.edge(chain.edge);
  const int count = static_cast<int>(chain.nodes.size());
  std::vector<double> gaps;
  for (int i = 0; i + 1 < count; ++i) gaps.push_back((points[chain.nodes[i + 1]] - points[chain.nodes[i]]).norm());
  const CadRef first = entities.cad(chain.nodes.front()), last = entities.cad(chain.nodes.back());

  // Where the nodes project to, kept if they are in order and nowhere bunched.
  std::vector<double> found(count);
  for (int i = 0; i < count; ++i) found[i] = arc.length(model.project_to_edge(chain.edge, points[chain.nodes[i]]).t);

  // Both directions are tried; the one nearer to where the nodes are wins.
  std::vector<double> best;
  double least = -1;
  for (const bool forward : {true, false}) {
    double from = forward ? 0 : arc.total(), to = arc.total() - from;
    if (edge.vertices[0] != edge.vertices[1]) {
      if (first.dim == 0 && first.id != edge.vertices[forward ? 0 : 1]) continue;
      if (last.dim == 0 && last.id != edge.vertices[forward ? 1 : 0]) continue;
    } else if (first.dim != 0) {
      from = found[0];  // a loop without its vertex starts where its first node is
      to = forward ? from + arc.total() : from - arc.total();
    }
    const auto wrap = [&](double s) { return s < 0 ? s + arc.total() : s > arc.total() ? s - arc.total() : s; };
    const auto lengths = spread(gaps, from, to);
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += (model.edge_point(chain.edge, arc.parameter(wrap(lengths[i]))) - points[chain.nodes[i]]).squaredNorm();
    if (least >= 0 && sum >= least) continue;
    least = sum;
    best = lengths;
    for (double& s : best) s = wrap(s);
    // Projections of inner nodes in the right order beat proportions.
    const double even = arc.total() / (count - 1), sign = forward ? 1 : -1;
    if (first.dim == 0) {
      std::vector<double> kept = found;
      kept.front() = from;
      kept.back() = to;
      bool in_order = true;
      for (int i = 0; i + 1 < count; ++i) in_order = in_order && sign * (kept[i + 1] - kept[i]) > 0.3 * std::min(even, gaps[i]);
      if (in_order) best = kept;
    }
  }
  if (best.empty()) return;
  for (int i = 0; i < count; ++i) {
    const int node = chain.nodes[i];
    if (entities.dimension(node) != 1) continue;
    const double t = arc.parameter(best[i]);
    entities.set_edge_parameter(node, t);
    points[node] = model.edge_point(chain.edge, t);
  }
}

}  // namespace

struct Chains::Chain {
  NodeChain nodes;
  ArcLength arc;
};

Chains::Chains(const CadModel& model, const Association& association) : model_(model) {
  for (const NodeChain& chain : find_chains(association)) {
    chains_.push_back(std::make_shared<const Chain>(Chain{chain, ArcLength(model, chain.edge)}));
  }
}

void Chains::place(std::vector<Vec3>& points, Entities& entities) const {
  for (const auto& chain : chains_) place_chain(model_, chain->nodes, chain->arc, points, entities);
}

// The direction of a chain that has one vertex or none is that in which most of its pairs go.
bool Chains::forward(const Chain& chain, const std::vector<double>& lengths, const Entities& entities) const {
  const CadEdge& cad = model_.edge(chain.nodes.edge);
  const CadRef first = entities.cad(chain.nodes.nodes.front());
  if (cad.vertices[0] != cad.vertices[1]) return cad.vertices[0] == first.id;
  int rising = 0;
  for (std::size_t i = 1; i + 2 < lengths.size(); ++i) rising += lengths[i + 1] > lengths[i] ? 1 : -1;
  return rising >= 0;
}

std::vector<Turn> Chains::turns(const std::vector<Vec3>& points, const Entities& entities) const {
  std::vector<Turn> turns;
  for (const auto& chain : chains_) {
    const auto& nodes = chain->nodes.nodes;
    const ArcLength& arc = chain->arc;
    const bool cut = entities.dimension(nodes.front()) != 0 && nodes.front() != nodes.back();
    if (arc.total_turn() < kFitTuning.straight || cut || nodes.size() < 3) continue;
    const auto [from, to] = model_.edge_range(chain->nodes.edge);
    std::vector<double> t, lengths;
    for (int v : nodes) t.push_back(entities.dimension(v) == 1 ? entities.edge_parameter(v) : from);
    for (double x : t) lengths.push_back(arc.length(x));
    const bool ahead = forward(*chain, lengths, entities);
    const bool loop = entities.dimension(nodes.front()) != 0;
    if (!loop) {
      t.front() = ahead ? from : to;
      t.back() = ahead ? to : from;
    }
    const double sign = ahead ? 1 : -1;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
      Turn turn;
      turn.angle = sign * (arc.turned(t[i + 1]) - arc.turned(t[i]));
      if (loop && turn.angle < 0) turn.angle += arc.total_turn();
      for (int k = 0; k < 2; ++k) {
        const int v = nodes[i + k];
        turn.nodes[k] = v;
        turn.places[k] = points[v];
        turn.slopes[k] = (k == 0 ? -sign : sign) * arc.curvature(t[i + k]) * model_.edge_tangent(chain->nodes.edge, t[i + k]);
      }
      turns.push_back(turn);
    }
  }
  return turns;
}

void Chains::keep_order(std::vector<Vec3>& points, Entities& entities) const {
  for (const auto& chain : chains_) {
    const auto& [edge, nodes] = chain->nodes;
    const int count = static_cast<int>(nodes.size());
    if (count < 3 || entities.dimension(nodes.front()) != 0 || entities.dimension(nodes.back()) != 0) continue;
    const double total = chain->arc.total(), least = 0.1 * total / (count - 1);
    std::vector<double> s(count, 0);
    for (int i = 1; i + 1 < count; ++i) s[i] = chain->arc.length(entities.edge_parameter(nodes[i]));
    const bool ahead = forward(*chain, s, entities);
    if (!ahead) {
      for (double& x : s) x = total - x;
    }
    s.front() = 0;
    s.back() = total;
    const std::vector<double> before = s;
    for (int i = 1; i + 1 < count; ++i) s[i] = std::max(s[i], s[i - 1] + least);
    for (int i = count - 2; i > 0; --i) s[i] = std::min(s[i], s[i + 1] - least);
    for (int i = 1; i + 1 < count; ++i) {
      if (s[i] == before[i]) continue;
      const double t = chain->arc.parameter(ahead ? s[i] : total - s[i]);
      entities.set_edge_parameter(nodes[i], t);
      points[nodes[i]] = entities.project(nodes[i], model_.edge_point(edge, t));
    }
  }
}

void place_on_cad(const CadModel& model, HexMesh& mesh, const Association& association, const Chains& chains, Entities& entities, const Monitor& monitor) {
  const std::vector<Vec3> before = mesh.points;
  for (int v : entities.boundary()) {
    if (entities.dimension(v) == 0) mesh.points[v] = model.vertex(entities.cad(v).id);
  }
  chains.place(mesh.points, entities);
  monitor.check();
  std::vector<Segment> surface_edges, edges;
  for (const Quad& q : association.quads) {
    for (int k = 0; k < 4; ++k) surface_edges.push_back({q[k], q[(k + 1) % 4]});
  }
  std::vector<char> on_patch(mesh.points.size(), 0), inside(mesh.points.size(), 0);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    on_patch[v] = association.point_cad[v].dim == 2;
    inside[v] = association.point_cad[v].dim == 3;
  }
  follow(mesh.points, before, unique_edges(std::move(surface_edges)), on_patch);
  monitor.check();
  entities.project(mesh.points);
  monitor.check();
  for (const Hex& hex : mesh.hexes) {
    for (const auto& [c, d] : kHexEdges) edges.push_back({hex[c], hex[d]});
  }
  follow(mesh.points, before, unique_edges(std::move(edges)), inside);
}

}  // namespace polycube
