#include "label/graph_cut.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

namespace polycube {
namespace {

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Node {
  Traits::edge_descriptor predecessor{};
  boost::default_color_type color{};
  double distance = 0;
};
struct Arc {
  double capacity = 0;
  double residual = 0;
  Traits::edge_descriptor reverse{};
};
using Network = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Node, Arc>;

double pair_cost(int p, int q) { return p == q ? 0 : (p / 2 == q / 2 ? 2 : 1); }

void add_arcs(Network& g, std::size_t a, std::size_t b, double forward, double backward) {
  const auto e = boost::add_edge(a, b, g).first;
  const auto r = boost::add_edge(b, a, g).first;
  g[e].capacity = forward;
  g[r].capacity = backward;
  g[e].reverse = r;
  g[r].reverse = e;
}

// One expansion move: every node keeps its label (source side) or takes alpha (sink side). Exact for this metric pair cost.
std::vector<int> expand(const CutProblem& problem, const std::vector<int>& labels, int alpha) {
  const std::size_t n = problem.data.size(), source = n, sink = n + 1;
  std::vector<double> keep(n), take(n);
  for (std::size_t i = 0; i < n; ++i) {
    keep[i] = problem.data[i][labels[i]];
    take[i] = problem.data[i][alpha];
  }
  Network g(n + 2);
  for (const auto& link : problem.links) {
    // Kolmogorov and Zabih 2004: E(keep,keep)=A, E(keep,take)=B, E(take,keep)=C, E(take,take)=0.
    const double a = link.weight * pair_cost(labels[link.a], labels[link.b]);
    const double b = link.weight * pair_cost(labels[link.a], alpha), c = link.weight * pair_cost(alpha, labels[link.b]);
    take[link.a] += c - a;
    take[link.b] += -c;
    add_arcs(g, static_cast<std::size_t>(link.a), static_cast<std::size_t>(link.b), b + c - a, 0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double low = std::min(keep[i], take[i]);
    // Cutting source->i puts i on the sink side (take); cutting i->sink leaves it on the source side (keep).
    add_arcs(g, source, i, take[i] - low, 0);
    add_arcs(g, i, sink, keep[i] - low, 0);
  }
  boost::boykov_kolmogorov_max_flow(g, boost::get(&Arc::capacity, g), boost::get(&Arc::residual, g), boost::get(&Arc::reverse, g),
                                    boost::get(&Node::predecessor, g), boost::get(&Node::color, g), boost::get(&Node::distance, g),
                                    boost::get(boost::vertex_index, g), source, sink);
  std::vector<int> result = labels;
  for (std::size_t i = 0; i < n; ++i) {
    if (g[i].color != boost::black_color) result[i] = alpha;
  }
  return result;
}

}  // namespace

double energy(const CutProblem& problem, const std::vector<int>& labels) {
  double sum = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) sum += problem.data[i][labels[i]];
  for (const auto& link : problem.links) sum += link.weight * pair_cost(labels[link.a], labels[link.b]);
  return sum;
}

std::vector<int> solve(const CutProblem& problem, const Monitor& monitor) {
  std::vector<int> labels(problem.data.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = static_cast<int>(std::min_element(problem.data[i].begin(), problem.data[i].end()) - problem.data[i].begin());
  }
  double best = energy(problem, labels);
  for (int round = 0; round < 8; ++round) {
    bool better = false;
    for (int alpha = 0; alpha < 6; ++alpha) {
      monitor.check();
      std::vector<int> next = expand(problem, labels, alpha);
      const double e = energy(problem, next);
      if (e >= best - 1e-9 * (1 + std::abs(best))) continue;
      best = e;
      labels = std::move(next);
      better = true;
    }
    if (!better) break;
  }
  return labels;
}

}  // namespace polycube
