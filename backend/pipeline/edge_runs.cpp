#include "pipeline/edge_runs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace polycube {

EdgeRuns::EdgeRuns(const TetMesh& tets, const PolycuboidMap& map, const BlockComplex& blocks) : map_(map), blocks_(blocks), charts_at_(tets.points.size()) {
  for (int c = 0; c < static_cast<int>(map.charts.size()); ++c) {
    for (int n : map.charts[c].nodes) charts_at_[n][map.charts[c].axis].push_back(c);
  }
}

int EdgeRuns::unknown_at(int node, int axis) const {
  for (int c : charts_at_[node][axis]) {
    if (blocks_.unknown[c] >= 0) return blocks_.unknown[c];
  }
  return -1;
}

bool EdgeRuns::held(int a, int b, int axis) const {
  const auto &at_a = charts_at_[a][axis], &at_b = charts_at_[b][axis];
  return std::any_of(at_a.begin(), at_a.end(), [&](int c) { return std::find(at_b.begin(), at_b.end(), c) != at_b.end(); });
}

std::vector<EdgeRun> EdgeRuns::of(const std::vector<int>& chain) const {
  if (chain.size() < 2) return {};
  const std::size_t count = chain.size() - 1;
  std::vector<int> along(count, -1);  // per segment: the axis that it runs along
  for (std::size_t i = 0; i < count; ++i) {
    double most = 0;
    for (int d = 0; d < 3; ++d) {
      const double step = std::abs(map_.image[chain[i + 1]][d] - map_.image[chain[i]][d]);
      if (held(chain[i], chain[i + 1], d) || step <= most) continue;
      most = step;
      along[i] = d;
    }
  }
  // A closed edge starts anywhere: the runs start at a turn.
  std::size_t first = 0;
  if (chain.front() == chain.back()) {
    while (first < count && along[first] == along[(first + count - 1) % count]) ++first;
    if (first == count) return {};
  }
  std::vector<EdgeRun> runs;
  for (std::size_t i = 0; i < count;) {
    const int axis = along[(first + i) % count];
    const int from_node = chain[(first + i) % count];
    for (; i < count && (along[(first + i) % count] == axis || along[(first + i) % count] < 0); ++i) {
    }
    const int to_node = chain[(first + i - 1) % count + 1];
    if (axis < 0) continue;
    const int from = unknown_at(from_node, axis), to = unknown_at(to_node, axis);
    if (from >= 0 && from == to) continue;
    runs.push_back({axis, from, to, from_node, to_node, std::abs(map_.image[to_node][axis] - map_.image[from_node][axis])});
  }
  return runs;
}

std::vector<DistanceConstraint> room_for_edges(const std::vector<std::vector<int>>& chains, const TetMesh& tets, const PolycuboidMap& map,
                                               const BlockComplex& blocks) {
  const EdgeRuns runs(tets, map, blocks);
  // Places along an axis in ascending order, with the runs that go up from each. A place is (value, chart) or (value, -1 - node).
  using Place = std::pair<double, int>;
  std::array<std::map<Place, std::set<Place>>, 3> up;
  for (const std::vector<int>& chain : chains) {
    for (const EdgeRun& run : runs.of(chain)) {
      const auto place = [&](int chart, int node) { return chart >= 0 ? Place(map.charts[chart].value, chart) : Place(map.image[node][run.axis], -1 - node); };
      const Place from = place(run.from, run.from_node), to = place(run.to, run.to_node);
      if (from.first != to.first) up[run.axis][std::min(from, to)].insert(std::max(from, to));
    }
  }
  std::vector<DistanceConstraint> constraints;
  for (const auto& links : up) {
    for (const auto& [start, ignored] : links) {
      if (start.second < 0) continue;
      std::map<Place, int> passed{{start, 0}};  // most edges from the start to a place, by places between that nothing holds
      for (auto it = passed.begin(); it != passed.end(); ++it) {
        const auto& [at, count] = *it;
        if (at.second >= 0 && at != start) {
          if (count > 1) constraints.push_back({start.second, at.second, count, std::numeric_limits<int>::max(), "room for edges", true});
          continue;
        }
        const auto next = links.find(at);
        if (next == links.end()) continue;
        for (const Place& p : next->second) passed[p] = std::max(passed[p], count + 1);
      }
    }
  }
  return constraints;
}

}  // namespace polycube
