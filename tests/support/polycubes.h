// Polycuboid maps made from unit cells, for tests of blocks, quantize and hex. Cells may overlap in the image (spirals): which of them
// adjoin is stated, not derived from their places.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "blocks/blocks.h"
#include "core/charts.h"
#include "core/hexahedron.h"
#include "core/union_find.h"

namespace polycube::testing {

using Place3 = std::array<int, 3>;

struct Cells {
  std::vector<Place3> places;
  std::vector<std::array<int, 6>> neighbours;  ///< per side (-u +u -v +v -w +w), -1 for none
};

inline Place3 beside(Place3 p, int side) {
  p[side / 2] += side % 2 == 0 ? -1 : 1;
  return p;
}

/// All cells of a set, every two that share a face adjoining.
inline Cells voxels(const std::set<Place3>& places) {
  Cells cells;
  std::map<Place3, int> index;
  for (const Place3& p : places) {
    index[p] = static_cast<int>(cells.places.size());
    cells.places.push_back(p);
  }
  for (const Place3& p : cells.places) {
    std::array<int, 6> n;
    for (int side = 0; side < 6; ++side) {
      const auto at = index.find(beside(p, side));
      n[side] = at == index.end() ? -1 : at->second;
    }
    cells.neighbours.push_back(n);
  }
  return cells;
}

inline void add_box(std::set<Place3>& places, const Place3& low, const Place3& high) {
  for (int i = low[0]; i < high[0]; ++i) {
    for (int j = low[1]; j < high[1]; ++j) {
      for (int k = low[2]; k < high[2]; ++k) places.insert({i, j, k});
    }
  }
}

inline void remove_box(std::set<Place3>& places, const Place3& low, const Place3& high) {
  std::erase_if(places,
                [&](const Place3& p) { return p[0] >= low[0] && p[0] < high[0] && p[1] >= low[1] && p[1] < high[1] && p[2] >= low[2] && p[2] < high[2]; });
}

inline Cells box_cells(const Place3& size) {
  std::set<Place3> places;
  add_box(places, {0, 0, 0}, size);
  return voxels(places);
}

/// A chain of cells, each adjoining the one before and the one after only: steps are sides. It may pass through itself.
inline Cells chain(const std::vector<int>& steps) {
  Cells cells;
  Place3 at{0, 0, 0};
  std::array<int, 6> none;
  none.fill(-1);
  cells.places.push_back(at);
  cells.neighbours.push_back(none);
  for (int side : steps) {
    const int last = static_cast<int>(cells.places.size()) - 1;
    at = beside(at, side);
    cells.places.push_back(at);
    cells.neighbours.push_back(none);
    cells.neighbours[last][side] = last + 1;
    cells.neighbours[last + 1][side ^ 1] = last;
  }
  return cells;
}

/// A flat spiral of `turns` corners that comes back over its own beginning.
inline Cells flat_spiral(int corners, int length = 3) {
  std::vector<int> steps;
  const std::array<int, 4> directions{1, 3, 0, 2};
  for (int c = 0; c <= corners; ++c) steps.insert(steps.end(), static_cast<std::size_t>(length), directions[static_cast<std::size_t>(c % 4)]);
  return chain(steps);
}

/// A spring whose turns lie over one another: every turn goes up one level and down again.
inline Cells spring(int turns, int length = 3) {
  std::vector<int> steps;
  for (int t = 0; t < turns; ++t) {
    for (int side : {1, 5, 3, 0, 4, 2}) steps.insert(steps.end(), static_cast<std::size_t>(length), side);
  }
  return chain(steps);
}

/// A chain of `runs` straight pieces with random right-angled turns; sooner or later it passes through itself.
inline Cells random_chain(std::mt19937& random, int runs) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::vector<int> steps;
  int last = pick(0, 5);
  for (int r = 0; r < runs; ++r) {
    // Two steps at least, or a turn back would lie against the piece before the last.
    steps.insert(steps.end(), static_cast<std::size_t>(pick(2, 4)), last);
    last = (2 * (last / 2 + pick(1, 2)) + pick(0, 1)) % 6;
  }
  return chain(steps);
}

/// Each cell refined to m x m x m.
inline Cells refine(const Cells& cells, int m) {
  Cells fine;
  const auto index = [&](int cell, int i, int j, int k) { return cell * m * m * m + (i * m + j) * m + k; };
  for (int c = 0; c < static_cast<int>(cells.places.size()); ++c) {
    for (int i = 0; i < m; ++i) {
      for (int j = 0; j < m; ++j) {
        for (int k = 0; k < m; ++k) {
          const Place3 at{i, j, k};
          fine.places.push_back({cells.places[c][0] * m + i, cells.places[c][1] * m + j, cells.places[c][2] * m + k});
          std::array<int, 6> n;
          for (int side = 0; side < 6; ++side) {
            Place3 to = beside(at, side);
            const int d = side / 2;
            int cell = c;
            if (to[d] < 0 || to[d] >= m) {
              cell = cells.neighbours[c][side];
              to[d] = (to[d] + m) % m;
            }
            n[side] = cell < 0 ? -1 : index(cell, to[0], to[1], to[2]);
          }
          fine.neighbours.push_back(n);
        }
      }
    }
  }
  return fine;
}

/// Nodes of the cells: corners joined across adjoining faces.
inline std::vector<Hex> cell_nodes(const Cells& cells, std::vector<Place3>& places) {
  std::vector<int> parent(8 * cells.places.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (int c = 0; c < static_cast<int>(cells.places.size()); ++c) {
    for (int side = 0; side < 6; ++side) {
      const int n = cells.neighbours[c][side];
      if (n < 0) continue;
      for (int k : kHexFaces[side]) {
        auto other = kCornerCoordinates[k];
        other[side / 2] = 1 - other[side / 2];
        const auto at = std::find(kCornerCoordinates.begin(), kCornerCoordinates.end(), other) - kCornerCoordinates.begin();
        const int a = find(8 * c + k), b = find(8 * n + static_cast<int>(at));
        parent[std::max(a, b)] = std::min(a, b);
      }
    }
  }
  std::vector<int> number(parent.size(), -1);
  std::vector<Hex> nodes(cells.places.size());
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) {
    int& n = number[find(i)];
    if (n < 0) {
      n = static_cast<int>(places.size());
      const auto& k = kCornerCoordinates[i % 8];
      const Place3& p = cells.places[i / 8];
      places.push_back({p[0] + k[0], p[1] + k[1], p[2] + k[2]});
    }
    nodes[i / 8][i % 8] = n;
  }
  return nodes;
}

/// Whether two cells that share an edge lie side by side without adjoining: a slit of no width.
inline bool has_slit(const Cells& cells) {
  std::vector<Place3> places;
  const auto nodes = cell_nodes(cells, places);
  std::multimap<Place3, int> at;
  for (int c = 0; c < static_cast<int>(cells.places.size()); ++c) at.emplace(cells.places[c], c);
  for (int c = 0; c < static_cast<int>(cells.places.size()); ++c) {
    for (int side : {1, 3, 5}) {
      const auto [begin, end] = at.equal_range(beside(cells.places[c], side));
      for (auto other = begin; other != end; ++other) {
        if (cells.neighbours[c][side] == other->second) continue;
        int shared = 0;
        for (int a : kHexFaces[side]) {
          for (int b : kHexFaces[side - 1]) shared += nodes[c][a] == nodes[other->second][b];
        }
        if (shared >= 2) return true;
      }
    }
  }
  return false;
}

/// Boxes grown from random free sides of the boxes before: a tree, whose branches may pass through one another.
inline Cells box_tree(std::mt19937& random, int boxes) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  Cells cells;
  const auto add = [&](const Place3& low, const Place3& high) {
    std::set<Place3> places;
    add_box(places, low, high);
    const Cells box = voxels(places);
    const int first = static_cast<int>(cells.places.size());
    for (std::size_t c = 0; c < box.places.size(); ++c) {
      cells.places.push_back(box.places[c]);
      auto n = box.neighbours[c];
      for (int& k : n) k = k < 0 ? -1 : k + first;
      cells.neighbours.push_back(n);
    }
    return first;
  };
  add({0, 0, 0}, {pick(1, 3), pick(1, 3), pick(1, 3)});
  for (int b = 1; b < boxes; ++b) {
    const int side = pick(0, 5), axis = side / 2, right = (axis + 1) % 3, up = (axis + 2) % 3;
    const int width = pick(1, 2), height = pick(1, 2), length = pick(1, 3);
    // The cells that the branch stands on.
    std::map<Place3, int> foot;
    int row = pick(0, static_cast<int>(cells.places.size()) - 1);
    for (int i = 0; i < width && row >= 0; ++i, row = cells.neighbours[row][2 * right + 1]) {
      int c = row;
      for (int j = 0; j < height && c >= 0; ++j, c = cells.neighbours[c][2 * up + 1]) foot[beside(cells.places[c], side)] = c;
    }
    const auto free = [&](const auto& f) { return cells.neighbours[f.second][side] < 0; };
    if (foot.size() != static_cast<std::size_t>(width * height) || !std::all_of(foot.begin(), foot.end(), free)) continue;
    Place3 low = foot.begin()->first, high = beside(beside(beside(foot.rbegin()->first, 1), 3), 5);
    (side % 2 == 0 ? low : high)[axis] += side % 2 == 0 ? 1 - length : length - 1;
    Cells before = cells;
    const int first = add(low, high);
    for (int c = first; c < static_cast<int>(cells.places.size()); ++c) {
      const auto at = foot.find(cells.places[c]);
      if (at == foot.end()) continue;
      cells.neighbours[at->second][side] = c;
      cells.neighbours[c][side ^ 1] = at->second;
    }
    if (has_slit(cells)) cells = std::move(before);
  }
  return cells;
}

/// Whether the boundary of cells in space is a manifold: nowhere does it touch itself, not even along an edge.
inline bool is_manifold(const Cells& cells) {
  std::map<Place3, int> node_at;
  std::vector<Hex> nodes(cells.places.size());
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    for (int k = 0; k < 8; ++k) {
      const auto& [i, j, l] = kCornerCoordinates[k];
      const Place3 p{cells.places[c][0] + i, cells.places[c][1] + j, cells.places[c][2] + l};
      nodes[c][k] = node_at.try_emplace(p, static_cast<int>(node_at.size())).first->second;
    }
  }
  std::map<std::array<int, 2>, std::vector<int>> edges;  // quads
  std::map<int, std::vector<int>> corners;
  int quads = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    for (int side = 0; side < 6; ++side) {
      if (cells.neighbours[c][side] >= 0) continue;
      for (int k = 0; k < 4; ++k) {
        const int a = nodes[c][kHexFaces[side][k]], b = nodes[c][kHexFaces[side][(k + 1) % 4]];
        edges[{std::min(a, b), std::max(a, b)}].push_back(quads);
        corners[a].push_back(quads);
      }
      ++quads;
    }
  }
  for (const auto& [edge, q] : edges) {
    if (q.size() != 2) return false;
  }
  for (const auto& [node, around] : corners) {
    std::set<int> reached{around.front()};
    for (bool grown = true; grown;) {
      grown = false;
      for (const auto& [edge, q] : edges) {
        if (edge[0] != node && edge[1] != node) continue;
        if (reached.count(q[0]) == reached.count(q[1])) continue;
        reached.insert(q[0]);
        reached.insert(q[1]);
        grown = true;
      }
    }
    if (reached.size() != around.size()) return false;
  }
  return true;
}

struct Example {
  TetMesh tets;
  PolycuboidMap map;
  std::vector<char> inner;  ///< per point: on no chart
};

/// Six tets a cell; points are the cells' places times 1 / m, image equal to points; charts from the sides' directions.
inline Example tetrahedralise(const Cells& coarse, int m = 1) {
  const Cells cells = refine(coarse, m);
  Example e;
  std::vector<Place3> places;
  const auto nodes = cell_nodes(cells, places);
  for (const Place3& p : places) e.tets.points.push_back(Vec3(p[0], p[1], p[2]) / m);
  // Paths from corner 000 to 111, one per order of the axes.
  const auto corner = [](const std::array<int, 3>& at) {
    return static_cast<int>(std::find(kCornerCoordinates.begin(), kCornerCoordinates.end(), at) - kCornerCoordinates.begin());
  };
  std::vector<int> labels;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    std::array<int, 3> order{0, 1, 2};
    do {
      std::array<int, 3> at{0, 0, 0};
      Tet tet{nodes[c][0], 0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i) {
        at[static_cast<std::size_t>(order[i])] = 1;
        tet[i + 1] = nodes[c][corner(at)];
      }
      const bool odd = (order[1] - order[0] + 3) % 3 == 2;
      if (odd) std::swap(tet[2], tet[3]);
      e.tets.tets.push_back(tet);
    } while (std::next_permutation(order.begin(), order.end()));
    for (int side = 0; side < 6; ++side) {
      if (cells.neighbours[c][side] >= 0) continue;
      // The diagonal from the face's smallest to its largest corner.
      std::array<int, 3> low{0, 0, 0}, high{1, 1, 1};
      low[side / 2] = high[side / 2] = side % 2;
      const int from = corner(low), to = corner(high);
      const auto& f = kHexFaces[side];
      const auto start = std::find(f.begin(), f.end(), from) - f.begin();
      const auto at = [&](std::ptrdiff_t k) { return nodes[c][f[static_cast<std::size_t>((start + k) % 4)]]; };
      e.tets.triangles.push_back({nodes[c][from], at(1), nodes[c][to]});
      e.tets.triangles.push_back({nodes[c][from], nodes[c][to], at(3)});
      const int label = side % 2 == 1 ? side - 1 : side + 1;
      labels.insert(labels.end(), 2, label);
    }
  }
  e.map.image = e.tets.points;
  e.map.charts = find_charts(e.tets.triangles, labels);
  for (Chart& chart : e.map.charts) chart.value = e.map.image[chart.nodes.front()][chart.axis];
  e.tets.point_cad.assign(e.tets.points.size(), CadRef{});
  e.tets.triangle_face.assign(e.tets.triangles.size(), 1);
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    for (int t : e.map.charts[c].triangles) e.tets.triangle_face[t] = static_cast<int>(c) + 1;
  }
  e.inner.assign(e.tets.points.size(), 1);
  for (const Chart& chart : e.map.charts) {
    for (int n : chart.nodes) e.inner[n] = 0;
  }
  return e;
}

/// Gives charts new values and the other nodes the mean of their neighbours, many times over: a smooth map. Charts of one axis that meet
/// in a node take the value of the first of them.
inline void set_values(Example& e, std::vector<double> values, int rounds = 60) {
  UnionFind same(values.size());
  std::vector<std::array<int, 3>> at(e.tets.points.size(), {-1, -1, -1});
  for (int c = 0; c < static_cast<int>(values.size()); ++c) {
    for (int n : e.map.charts[c].nodes) {
      int& first = at[n][e.map.charts[c].axis];
      if (first < 0) first = c;
      same.unite(first, c);
    }
  }
  for (int c = 0; c < static_cast<int>(values.size()); ++c) values[c] = values[same.find(c)];
  std::vector<std::array<char, 3>> fixed(e.tets.points.size(), {0, 0, 0});
  for (std::size_t c = 0; c < e.map.charts.size(); ++c) {
    Chart& chart = e.map.charts[c];
    chart.value = values[c];
    for (int n : chart.nodes) {
      e.map.image[n][chart.axis] = values[c];
      fixed[n][chart.axis] = 1;
    }
  }
  std::vector<std::set<int>> around(e.tets.points.size());
  for (const Tet& tet : e.tets.tets) {
    for (int a : tet) {
      for (int b : tet) {
        if (a != b && (e.tets.points[a] - e.tets.points[b]).cwiseAbs().minCoeff() == 0) around[a].insert(b);
      }
    }
  }
  for (int r = 0; r < rounds; ++r) {
    for (std::size_t n = 0; n < around.size(); ++n) {
      Vec3 mean = Vec3::Zero();
      for (int k : around[n]) mean += e.map.image[k] / static_cast<double>(around[n].size());
      for (int d = 0; d < 3; ++d) {
        if (!fixed[n][d]) e.map.image[n][d] = mean[d];
      }
    }
  }
}

inline int flipped_tets(const Example& e) {
  int count = 0;
  for (const Tet& t : e.tets.tets) {
    Mat3 j;
    for (int k = 0; k < 3; ++k) j.col(k) = e.map.image[t[k + 1]] - e.map.image[t[0]];
    count += j(0, 0) * (j(1, 1) * j(2, 2) - j(1, 2) * j(2, 1)) - j(0, 1) * (j(1, 0) * j(2, 2) - j(1, 2) * j(2, 0)) +
                 j(0, 2) * (j(1, 0) * j(2, 1) - j(1, 1) * j(2, 0)) <=
             0;
  }
  return count;
}

/// Moves inner nodes at random by up to `distance`, or onto a neighbour (squashed tets).
inline void disturb(Example& e, std::mt19937& random, double share, double distance) {
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Tet& tet : e.tets.tets) {
    if (!e.inner[tet[0]] || unit(random) > share) continue;
    if (unit(random) < 0.3) {
      e.map.image[tet[0]] = e.map.image[tet[1]];
    } else {
      for (int d = 0; d < 3; ++d) e.map.image[tet[0]][d] += distance * (2 * unit(random) - 1);
    }
  }
}

/// Adds a feature through the points whose image has coordinate `value` along `axis` and that `chosen` accepts.
template <class Chosen>
int add_feature(Example& e, int axis, double value, const Chosen& chosen) {
  Chart feature;
  feature.axis = axis;
  feature.sign = 0;
  feature.value = value;
  for (int n = 0; n < static_cast<int>(e.map.image.size()); ++n) {
    if (e.map.image[n][axis] == value && chosen(e.map.image[n])) feature.nodes.push_back(n);
  }
  e.map.charts.push_back(feature);
  return static_cast<int>(e.map.charts.size()) - 1;
}

inline bool is_connected(const Cells& cells) {
  std::vector<char> seen(cells.places.size(), 0);
  std::vector<int> reached{0};
  seen[0] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (int n : cells.neighbours[static_cast<std::size_t>(reached[i])]) {
      if (n < 0 || seen[static_cast<std::size_t>(n)]) continue;
      seen[static_cast<std::size_t>(n)] = 1;
      reached.push_back(n);
    }
  }
  return reached.size() == cells.places.size();
}

/// A box with holes drilled through it and hollows inside, all of one cell's width or more. Always connected and a manifold.
inline Cells drilled_box(std::mt19937& random, int holes) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const Place3 size{pick(3, 5), pick(3, 5), pick(3, 5)};
  std::set<Place3> places;
  add_box(places, {0, 0, 0}, size);
  for (int h = 0; h < holes; ++h) {
    Place3 low, high;
    for (int d = 0; d < 3; ++d) {
      low[d] = pick(1, size[d] - 2);
      high[d] = pick(low[d] + 1, size[d] - 1);
    }
    const int through = pick(0, 4);  // 3 and 4: a hollow
    if (through < 3) {
      low[through] = 0;
      high[through] = size[through];
    }
    auto trial = places;
    remove_box(trial, low, high);
    const Cells cells = voxels(trial);
    if (is_connected(cells) && is_manifold(cells)) places = std::move(trial);
  }
  return voxels(places);
}

/// Random boxes joined to one another, with boxes cut out: tunnels, cavities, pockets. Always connected and a manifold.
inline Cells random_cells(std::mt19937& random, int boxes, int size) {
  const auto pick = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::set<Place3> places;
  add_box(places, {0, 0, 0}, {pick(1, 3), pick(1, 3), pick(1, 3)});
  for (int b = 0; b < boxes; ++b) {
    auto trial = places;
    const Place3 low{pick(-1, size), pick(-1, size), pick(-1, size)};
    const Place3 high{low[0] + pick(1, 3), low[1] + pick(1, 3), low[2] + pick(1, 3)};
    if (pick(0, 3) == 0) {
      remove_box(trial, low, high);
    } else {
      add_box(trial, low, high);
    }
    if (trial.empty()) continue;
    const Cells cells = voxels(trial);
    if (is_connected(cells) && is_manifold(cells)) places = std::move(trial);
  }
  return voxels(places);
}

/// Other values for the charts, each moved by up to `spread`.
inline void shift_charts(Example& e, std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> unit(-spread, spread);
  std::vector<double> values;
  for (const Chart& c : e.map.charts) values.push_back(c.value + unit(random));
  set_values(e, values);
}

/// A strip with `count` pairs of dents as in the paper's figure 8, side by side, no two alike.
inline Example row_of_dents(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::set<Place3> places;
  add_box(places, {0, 0, 0}, {10 * count, 10, 1});
  for (int i = 0; i < count; ++i) {
    const int x = 10 * i;
    remove_box(places, {x + 2, 0, 0}, {x + 5, 5, 1});
    remove_box(places, {x + 5, 6, 0}, {x + 8, 10, 1});
  }
  Example e = tetrahedralise(voxels(places), 1);
  shift_charts(e, random, 0.2);
  return e;
}

}  // namespace polycube::testing
