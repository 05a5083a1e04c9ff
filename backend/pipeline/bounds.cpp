#include "pipeline/bounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hex/spacing.h"
#include "pipeline/circles.h"
#include "pipeline/edge_runs.h"
#include "pipeline/tuning.h"
#include "quantize/problem.h"

namespace polycube {
namespace {

constexpr int kNoMost = std::numeric_limits<int>::max();

/// A place along an axis: (value, chart) or (value, -1 - node) where the grid is free.
using Place = std::pair<double, int>;
struct Need {
  double elements = 0;
  std::string name;
};
/// Per place the ones above that a stretch of a CAD edge leads to.
using Stretches = std::map<Place, std::map<Place, Need>>;

/// How far the edge has turned at the tet mesh points along it.
std::map<int, double> turned_at(const CadModel& model, int edge, const std::vector<int>& chain, const TetMesh& tets) {
  const auto [first, last] = model.edge_range(edge);
  std::map<int, double> turned{{chain.front(), 0.0}};
  double t = first, sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const double next = i + 1 == chain.size() ? last : model.project_to_edge(edge, tets.points[chain[i]]).t;
    sum += edge_turn(model, edge, t, next);
    t = next;
    turned.try_emplace(chain[i], sum);
  }
  return turned;
}

/// The elements of a round edge shared out over its runs by how far each turns.
std::vector<double> shares(const RoundEdge& round, const std::vector<EdgeRun>& runs, const std::map<int, double>& turned) {
  std::vector<double> turns;
  double whole = 0;
  for (const EdgeRun& run : runs) {
    double turn = turned.at(run.to_node) - turned.at(run.from_node);
    if (turn <= 0) turn += round.turn;  // past the start of a closed edge
    turns.push_back(turn);
    whole += turn;
  }
  // Pieces of a circle may share its elements out otherwise; an arc has none to give away.
  const bool held = std::none_of(runs.begin(), runs.end(), [](const EdgeRun& r) { return r.from < 0 || r.to < 0; });
  std::vector<double> result;
  double passed = 0, before = 0;
  for (const double turn : turns) {
    const double share = round.elements * turn / whole;
    passed += share;
    const double now = held ? std::round(passed) : round.circle > 0 ? passed : before + std::ceil(share - kPipelineTuning.share_slack);
    result.push_back(now - before);
    before = now;
  }
  return result;
}

void bound_circles(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                   const std::vector<std::vector<int>>& edge_chains, const std::vector<RoundEdge>& rounds, const std::map<int, int>& more,
                   std::vector<DistanceConstraint>& constraints) {
  const EdgeRuns edge_runs(tets, map, blocks);
  std::array<Stretches, 3> up;
  for (RoundEdge round : rounds) {
    if (const auto at = more.find(round.edge); at != more.end()) round.elements += at->second;
    const std::vector<int>& chain = edge_chains[round.edge];
    const std::vector<EdgeRun> runs = edge_runs.of(chain);
    if (runs.empty()) continue;
    const std::vector<double> elements = shares(round, runs, turned_at(model, round.edge, chain, tets));
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const EdgeRun& run = runs[i];
      const auto place = [&](int chart, int node) { return chart >= 0 ? Place(map.charts[chart].value, chart) : Place(map.image[node][run.axis], -1 - node); };
      const Place from = place(run.from, run.from_node), to = place(run.to, run.to_node);
      if (from.first == to.first) continue;
      Need& need = up[run.axis][std::min(from, to)][std::max(from, to)];
      if (elements[i] > need.elements) need = {elements[i], round.name};
    }
  }
  for (const Stretches& stretches : up) {
    for (const auto& [start, unused] : stretches) {
      if (start.second < 0) continue;
      std::map<Place, Need> passed{{start, {}}};  // most elements from the start to a place, by places between that nothing holds
      for (auto it = passed.begin(); it != passed.end(); ++it) {
        const auto& [at, need] = *it;
        if (at.second >= 0 && at != start) {
          const int least = static_cast<int>(std::ceil(need.elements - kPipelineTuning.share_slack));
          if (least > 1) constraints.push_back({start.second, at.second, least, kNoMost, need.name, true});
          continue;
        }
        const auto next = stretches.find(at);
        if (next == stretches.end()) continue;
        for (const auto& [place, step] : next->second) {
          Need& there = passed[place];
          if (need.elements + step.elements > there.elements) there = {need.elements + step.elements, step.name};
        }
      }
    }
  }
}

void bound_walls(const BlockComplex& blocks, int layers, std::vector<DistanceConstraint>& constraints) {
  const std::string name = std::to_string(layers) + " elements through every wall";
  for (const auto& [axis, low, high] : opposite_charts(blocks)) constraints.push_back({low, high, layers, kNoMost, name, true});
}

/// Between any two charts on a line of blocks.
void bound_lengths(const PolycuboidMap& map, const BlockComplex& blocks, double longest, std::vector<DistanceConstraint>& constraints) {
  std::set<std::array<int, 2>> pairs;
  for (const Block& first : blocks.blocks) {
    for (int d = 0; d < 3; ++d) {
      for (const Block* last = &first;;) {
        pairs.insert({first.charts[d][0], last->charts[d][1]});
        const int next = last->neighbours[2 * d + 1];
        if (next < 0) break;
        last = &blocks.blocks[next];
      }
    }
  }
  for (const auto& [low, high] : pairs) {
    const double length = map.charts[high].value - map.charts[low].value;
    const int least = static_cast<int>(std::ceil(length / longest - kPipelineTuning.slack));
    if (least > 1) constraints.push_back({low, high, least, kNoMost, "no edge longer than the largest size", true});
  }
}

}  // namespace

std::vector<DistanceConstraint> part_bounds(const CadModel& model, const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks,
                                            const std::vector<std::vector<int>>& edge_chains, const MeshOptions& options, const std::map<int, int>& more,
                                            const EdgeLevels& levels) {
  std::vector<DistanceConstraint> constraints;
  bound_circles(model, tets, map, blocks, edge_chains, before_levels(round_edges(model, effective_per_circle(options)), levels), more, constraints);
  if (options.min_layers == 0 && effective_min_layers(options) > 1) bound_walls(blocks, effective_min_layers(options), constraints);
  const double longest = effective_max_size(options, model.diagonal());
  if (std::isfinite(longest)) bound_lengths(map, blocks, longest, constraints);
  return constraints;
}

std::vector<DistanceConstraint> neighbour_bounds(const PolycuboidMap& map, const BlockComplex& blocks, const std::vector<int>& value, double growth,
                                                 double size, bool local) {
  std::vector<DistanceConstraint> constraints;
  const BlockLayers layers = find_layers(blocks);
  const auto length = [&](int l) { return map.charts[layers.layers[l].high].value - map.charts[layers.layers[l].low].value; };
  const auto cells = [&](int l) { return value[layers.layers[l].high] - value[layers.layers[l].low]; };
  std::map<std::array<int, 2>, int> wide;
  for (std::size_t b = 0; b < blocks.blocks.size(); ++b) {
    double least = std::numeric_limits<double>::infinity();
    for (int d = 0; d < 3; ++d) least = std::min(least, length(layers.of[b][d]) / cells(layers.of[b][d]));
    if (!std::isfinite(least)) continue;  // squashed
    least = std::max(least, kPipelineTuning.thinnest * size);
    for (int d = 0; d < 3; ++d) {
      const int l = layers.of[b][d], needed = static_cast<int>(std::ceil(length(l) / (kPipelineTuning.widest_aspect * least) - kPipelineTuning.slack));
      int& most = wide[blocks.blocks[b].charts[d]];
      if (cells(l) > 0 && needed > cells(l)) most = std::max(most, needed);
    }
  }
  for (const auto& [charts, needed] : wide) {
    if (needed > 0) constraints.push_back({charts[0], charts[1], needed, kNoMost, "no cell longer than 10 times its width", true});
  }
  if (growth <= 1) return constraints;
  const std::string name = "cells that grow by " + std::to_string(growth).substr(0, 4) + " at most";
  for (int l = 0; l < static_cast<int>(layers.layers.size()); ++l) {
    if (cells(l) == 0) continue;
    const auto beside = layers_beside(blocks, layers, l, value);
    std::array<double, 2> first;
    for (const int s : {0, 1}) {
      first[s] = std::numeric_limits<double>::infinity();
      for (const int other : beside[s])
        first[s] = std::min(first[s], growth * std::max(length(other) / cells(other), (local ? kPipelineTuning.thinnest : kPipelineTuning.smallest) * size));
    }
    // Cells that grow from both ends until the layer is full.
    double low = first[0], high = first[1], covered = 0;
    int needed = 0;
    while (covered < length(l) * (1 - kPipelineTuning.slack) && needed < cells(l) * kPipelineTuning.most_rounds && std::isfinite(std::min(low, high))) {
      double& next = low < high ? low : high;
      covered += next;
      next *= growth;
      ++needed;
    }
    if (needed > cells(l)) constraints.push_back({layers.layers[l].low, layers.layers[l].high, needed, kNoMost, name, true});
  }
  return constraints;
}

std::vector<std::string> deciding(const std::vector<DistanceConstraint>& constraints, const PolycuboidMap& map, const std::vector<int>& value, double scale) {
  std::vector<std::string> names;
  for (const DistanceConstraint& c : constraints) {
    const int cells = value[c.high] - value[c.low];
    if (cells != c.at_least || cells <= std::lround(scale * (map.charts[c.high].value - map.charts[c.low].value))) continue;
    if (std::find(names.begin(), names.end(), c.name) == names.end()) names.push_back(c.name);
  }
  return names;
}

}  // namespace polycube
