#include "hex/spacing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/union_find.h"
#include "hex/tuning.h"

namespace polycube {
namespace {

/// Places 0 to 1 of the ends of cells.
std::vector<double> places_of(const std::vector<double>& lengths) {
  const double whole = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  std::vector<double> places{0};
  double passed = 0;
  for (const double l : lengths) places.push_back((passed += l) / whole);
  places.back() = 1;
  return places;
}

}  // namespace

BlockLayers find_layers(const BlockComplex& complex) {
  const int count = static_cast<int>(complex.blocks.size());
  BlockLayers result;
  result.of.resize(complex.blocks.size());
  for (int d = 0; d < 3; ++d) {
    UnionFind same(complex.blocks.size());
    for (int b = 0; b < count; ++b) {
      for (int side = 0; side < 6; ++side) {
        if (side / 2 != d && complex.blocks[b].neighbours[side] >= 0) same.unite(b, complex.blocks[b].neighbours[side]);
      }
    }
    std::vector<int> layer(complex.blocks.size(), -1);  // per root
    for (int b = 0; b < count; ++b) {
      int& l = layer[same.find(b)];
      if (l < 0) {
        l = static_cast<int>(result.layers.size());
        result.layers.push_back({d, complex.blocks[b].charts[d][0], complex.blocks[b].charts[d][1], {}});
      }
      result.layers[l].blocks.push_back(b);
      result.of[b][d] = l;
    }
  }
  return result;
}

std::array<std::vector<int>, 2> layers_beside(const BlockComplex& complex, const BlockLayers& layers, int layer, const std::vector<int>& value) {
  const int d = layers.layers[layer].axis;
  std::array<std::vector<int>, 2> beside;
  for (const int b : layers.layers[layer].blocks) {
    for (const int s : {0, 1}) {
      int next = complex.blocks[b].neighbours[2 * d + s];
      while (next >= 0 && value[complex.blocks[next].charts[d][0]] == value[complex.blocks[next].charts[d][1]])
        next = complex.blocks[next].neighbours[2 * d + s];
      if (next >= 0) beside[s].push_back(layers.of[next][d]);
    }
  }
  for (auto& list : beside) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return beside;
}

std::vector<double> graded(int count, double length, double first, double last, double growth) {
  const auto at_most = [&](double largest) {
    std::vector<double> lengths(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) lengths[i] = std::min({first * std::pow(growth, i), last * std::pow(growth, count - 1 - i), largest});
    return lengths;
  };
  double low = 0, high = length;
  for (int i = 0; i < kHexTuning.halvings; ++i) {
    const double middle = (low + high) / 2;
    const std::vector<double> lengths = at_most(middle);
    (std::accumulate(lengths.begin(), lengths.end(), 0.0) < length ? low : high) = middle;
  }
  std::vector<double> lengths = at_most(high);
  const double factor = length / std::accumulate(lengths.begin(), lengths.end(), 0.0);
  for (double& l : lengths) l *= factor;
  return lengths;
}

Spacing graded_spacing(const BlockComplex& complex, const PolycuboidMap& map, const std::vector<int>& value, double growth) {
  Spacing spacing{find_layers(complex), {}};
  const auto& layers = spacing.layers.layers;
  const auto cells = [&](int l) { return value[layers[l].high] - value[layers[l].low]; };
  const auto length = [&](int l) { return map.charts[layers[l].high].value - map.charts[layers[l].low].value; };
  spacing.places.resize(layers.size());
  if (growth <= 1) return spacing;
  for (int l = 0; l < static_cast<int>(layers.size()); ++l) {
    if (cells(l) < 2) continue;
    const double even = length(l) / cells(l);
    std::array<double, 2> ends{even, even};
    const auto beside = layers_beside(complex, spacing.layers, l, value);
    for (const int s : {0, 1}) {
      for (const int other : beside[s]) ends[s] = std::min(ends[s], growth * length(other) / cells(other));
    }
    if (ends[0] == even && ends[1] == even) continue;
    spacing.places[l] = places_of(graded(cells(l), length(l), ends[0], ends[1], growth));
  }
  return spacing;
}

void bias(const std::vector<int>& value, int from, int to, double factor, Spacing& spacing) {
  if (value[from] > value[to]) {
    std::swap(from, to);
    factor = 1 / factor;
  }
  // Layers end to end from one chart to the other.
  std::vector<int> reached{from};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (std::size_t l = 0; l < spacing.layers.layers.size(); ++l) {
      const BlockLayers::Layer& layer = spacing.layers.layers[l];
      const int cells = value[layer.high] - value[layer.low];
      if (layer.low != reached[i] || value[layer.high] > value[to]) continue;
      if (layer.high != to && std::find(reached.begin(), reached.end(), layer.high) == reached.end()) reached.push_back(layer.high);
      if (cells < 2) continue;
      std::vector<double> lengths{1};
      for (int k = 1; k < cells; ++k) lengths.push_back(lengths.back() * factor);
      spacing.places[l] = places_of(lengths);
    }
  }
}

}  // namespace polycube
