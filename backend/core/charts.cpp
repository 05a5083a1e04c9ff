#include "core/charts.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>

namespace polycube {

std::vector<std::array<int, 3>> triangle_neighbours(const std::vector<Triangle>& triangles) {
  std::vector<std::array<int, 3>> neighbours(triangles.size(), {-1, -1, -1});
  // Per undirected edge the side (3 * triangle + k) seen first; -1 once both sides are known.
  std::unordered_map<std::uint64_t, int> open;
  open.reserve(triangles.size() * 2);
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::uint32_t>(triangles[t][k]), b = static_cast<std::uint32_t>(triangles[t][(k + 1) % 3]);
      const std::uint64_t key = static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
      auto [it, fresh] = open.try_emplace(key, 3 * t + k);
      if (fresh) continue;
      if (it->second < 0) throw std::invalid_argument("more than two triangles share an edge");
      neighbours[t][k] = it->second / 3;
      neighbours[it->second / 3][it->second % 3] = t;
      it->second = -1;
    }
  }
  return neighbours;
}

std::vector<Chart> find_charts(const std::vector<Triangle>& triangles, const std::vector<int>& labels) {
  const auto neighbours = triangle_neighbours(triangles);
  std::vector<Chart> charts;
  std::vector<char> seen(triangles.size(), 0);
  for (int seed = 0; seed < static_cast<int>(triangles.size()); ++seed) {
    if (seen[seed]) continue;
    Chart chart;
    chart.axis = label_axis(labels[seed]);
    chart.sign = label_sign(labels[seed]);
    chart.triangles.push_back(seed);
    seen[seed] = 1;
    for (std::size_t i = 0; i < chart.triangles.size(); ++i) {
      for (int n : neighbours[chart.triangles[i]]) {
        if (n < 0 || seen[n] || labels[n] != labels[seed]) continue;
        seen[n] = 1;
        chart.triangles.push_back(n);
      }
    }
    std::sort(chart.triangles.begin(), chart.triangles.end());
    for (int t : chart.triangles) chart.nodes.insert(chart.nodes.end(), triangles[t].begin(), triangles[t].end());
    std::sort(chart.nodes.begin(), chart.nodes.end());
    chart.nodes.erase(std::unique(chart.nodes.begin(), chart.nodes.end()), chart.nodes.end());
    charts.push_back(std::move(chart));
  }
  return charts;
}

std::array<unsigned char, 3> label_colour(int label) {
  static constexpr std::array<std::array<unsigned char, 3>, 6> kColours{
      {{236, 106, 94}, {90, 200, 205}, {118, 196, 92}, {214, 122, 208}, {100, 140, 235}, {240, 205, 90}}};
  return kColours.at(static_cast<std::size_t>(label));
}

}  // namespace polycube
