#include "label/validity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "core/charts.h"

namespace polycube {
namespace {

Vec3 label_vector(int label) {
  Vec3 v = Vec3::Zero();
  v[label_axis(label)] = label_sign(label);
  return v;
}

// Least rotation, so that a cyclic sequence has one spelling.
std::vector<int> canonical(std::vector<int> s) {
  std::vector<int> best = s;
  for (std::size_t i = 1; i < s.size(); ++i) {
    std::rotate(s.begin(), s.begin() + 1, s.end());
    best = std::min(best, s);
  }
  return best;
}

// Cyclic label orders, counter-clockwise from outside, at the boundary vertices of all manifold unions of the eight octants.
std::set<std::vector<int>> polycube_corners() {
  std::set<std::vector<int>> result;
  const auto connected = [](int mask) {
    int seen = mask & -mask;
    for (int pass = 0; pass < 8; ++pass) {
      for (int o = 0; o < 8; ++o) {
        if (!(seen >> o & 1)) continue;
        for (int axis = 0; axis < 3; ++axis) seen |= (1 << (o ^ (1 << axis))) & mask;
      }
    }
    return seen == mask;
  };
  for (int mask = 1; mask < 255; ++mask) {
    if (!connected(mask) || !connected(255 ^ mask)) continue;
    // The boundary consists of quarter faces between a filled octant and an empty one. Each quarter face is bounded at the vertex by two
    // half axes; walking counter-clockwise from outside it goes from one half axis to the next.
    std::vector<std::array<int, 3>> quarters;  // from half axis, to half axis, label; half axes numbered as labels
    for (int o = 0; o < 8; ++o) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!(mask >> o & 1) || (mask >> (o ^ (1 << axis)) & 1)) continue;
        const auto half = [&](int a) { return 2 * a + (o >> a & 1 ? 0 : 1); };  // bit set: positive side
        const int label = 2 * axis + (o >> axis & 1 ? 1 : 0);                   // faces away from the octant
        int from = half((axis + 1) % 3), to = half((axis + 2) % 3);
        const Vec3 n = label_vector(from).cross(label_vector(to));
        if (n.dot(label_vector(label)) < 0) std::swap(from, to);
        quarters.push_back({from, to, label});
      }
    }
    std::vector<int> order;
    int at = quarters.front()[0];
    bool manifold = true;
    for (std::size_t i = 0; i < quarters.size() && manifold; ++i) {
      const auto matches = std::count_if(quarters.begin(), quarters.end(), [&](const auto& q) { return q[0] == at; });
      manifold = matches == 1;
      const auto q = std::find_if(quarters.begin(), quarters.end(), [&](const auto& x) { return x[0] == at; });
      if (q == quarters.end()) break;
      order.push_back((*q)[2]);
      at = (*q)[1];
    }
    if (!manifold || at != quarters.front()[0]) continue;
    std::vector<int> reduced;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (order[i] != order[(i + 1) % order.size()]) reduced.push_back(order[i]);
    }
    if (reduced.size() >= 3) result.insert(canonical(reduced));
  }
  return result;
}

bool is_polycube_corner(const std::vector<int>& labels) {
  static const std::set<std::vector<int>> kCorners = polycube_corners();
  return kCorners.count(canonical(labels)) > 0;
}

class Checker {
 public:
  Checker(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& label, double noise)
      : g_(graph), points_(points), label_(label), noise_(noise) {}

  Violations run() {
    check_arcs();
    check_junctions();
    find_charts();
    check_loops();
    check_turns();
    for (const auto& r : hit_) result_.regions.push_back(r);
    result_.score = 10.0 * result_.opposite_arcs + 10.0 * result_.poor_loops + 6.0 * result_.bad_corners + 3.0 * result_.turning_points +
                    6.0 * result_.bad_turns;
    return std::move(result_);
  }

 private:
  bool border(int dart) const { return label_[dart_left(g_, dart)] != label_[dart_right(g_, dart)]; }
  int start_of(int dart) const { return dart % 2 == 0 ? g_.arcs[dart / 2].start : g_.arcs[dart / 2].end; }
  int end_of(int dart) const { return start_of(dart ^ 1); }

  void blame(int dart) {
    hit_.insert(dart_left(g_, dart));
    hit_.insert(dart_right(g_, dart));
  }

  void check_arcs() {
    for (int a = 0; a < static_cast<int>(g_.arcs.size()); ++a) {
      const int p = label_[g_.arcs[a].left], q = label_[g_.arcs[a].right];
      if (p == q || label_axis(p) != label_axis(q)) continue;
      ++result_.opposite_arcs;
      blame(2 * a);
    }
  }

  void check_junctions() {
    corner_.assign(g_.junctions.size(), 0);
    for (std::size_t j = 0; j < g_.junctions.size(); ++j) {
      std::vector<int> around;
      for (int d : g_.junctions[j].darts) {
        if (border(d)) around.push_back(label_[dart_left(g_, d)]);
      }
      if (around.size() <= 2) continue;
      corner_[j] = 1;
      if (is_polycube_corner(around)) continue;
      ++result_.bad_corners;
      result_.corners.push_back(static_cast<int>(j));
      for (int d : g_.junctions[j].darts) blame(d);
    }
  }

  void find_charts() {
    chart_.resize(g_.regions.size());
    std::iota(chart_.begin(), chart_.end(), 0);
    for (bool changed = true; changed;) {
      changed = false;
      for (const Arc& a : g_.arcs) {
        if (label_[a.left] != label_[a.right] || chart_[a.left] == chart_[a.right]) continue;
        chart_[a.left] = chart_[a.right] = std::min(chart_[a.left], chart_[a.right]);
        changed = true;
      }
    }
    turns_.assign(g_.regions.size(), 0);
    loops_.assign(g_.regions.size(), 0);
    unknown_.assign(g_.regions.size(), 0);
  }

  // A rectilinear polygon turns left four times more than right, a hole's border right; so turns tell of a chart that is inside out, and of one
  // without any border.
  void check_turns() {
    for (std::size_t r = 0; r < g_.regions.size(); ++r) {
      if (chart_[r] != static_cast<int>(r) || unknown_[r] || (loops_[r] > 0 && turns_[r] == 4 * (2 - loops_[r]))) continue;
      ++result_.bad_turns;
      if (loops_[r] == 0 && !unknown_[r]) result_.poor_loops += 6;  // the whole surface is one chart: it lacks the borders of a cube's six
      for (std::size_t m = 0; m < g_.regions.size(); ++m) {
        if (chart_[m] == static_cast<int>(r)) hit_.insert(static_cast<int>(m));
      }
    }
  }

  // The border dart that follows with the same chart on the left.
  int next(int dart) const {
    const auto& darts = g_.junctions[end_of(dart)].darts;
    const auto back = std::find(darts.begin(), darts.end(), dart ^ 1);
    std::size_t i = static_cast<std::size_t>(back - darts.begin());
    // Turning clockwise from the way back sweeps over the left side.
    do {
      i = (i + darts.size() - 1) % darts.size();
    } while (!border(darts[i]));
    return darts[i];
  }

  void append(int dart, std::vector<int>& nodes) const {
    const auto& chain = g_.arcs[dart / 2].nodes;
    if (dart % 2 == 0) {
      nodes.insert(nodes.end(), chain.begin() + (nodes.empty() ? 0 : 1), chain.end());
    } else {
      nodes.insert(nodes.end(), chain.rbegin() + (nodes.empty() ? 0 : 1), chain.rend());
    }
  }

  void check_loops() {
    std::vector<char> seen(2 * g_.arcs.size(), 0);
    for (int first = 0; first < static_cast<int>(2 * g_.arcs.size()); ++first) {
      if (seen[first] || !border(first)) continue;
      if (start_of(first) < 0) {  // a closed chain without junction
        seen[first] = 1;
        result_.poor_loops += 4;
        unknown_[chart_[dart_left(g_, first)]] = 1;
        blame(first);
        continue;
      }
      std::vector<int> loop;
      for (int d = first; !seen[d]; d = next(d)) {
        seen[d] = 1;
        loop.push_back(d);
      }
      check_loop(loop);
    }
  }

  void check_loop(std::vector<int>& loop) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (corner_[start_of(loop[i])]) corners.push_back(i);
    }
    if (corners.size() < 4) {
      result_.poor_loops += 4 - static_cast<int>(corners.size());
      for (int d : loop) blame(d);
      if (corners.empty()) {
        unknown_[chart_[dart_left(g_, loop.front())]] = 1;
        return;
      }
    }
    // The boundaries between consecutive corners, as axis directions of the polygon that the chart becomes.
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(corners.front()), loop.end());
    std::vector<Vec3> directions;
    bool known = true;
    const int mine = label_[dart_left(g_, loop.front())];
    for (std::size_t i = 0; i < loop.size();) {
      const int other = label_[dart_right(g_, loop[i])];
      std::vector<int> nodes;
      const int first = loop[i];
      do {
        append(loop[i], nodes);
        ++i;
      } while (i < loop.size() && !corner_[start_of(loop[i])]);
      if (label_axis(mine) == label_axis(other)) {
        known = false;
        continue;
      }
      const int axis = 3 - label_axis(mine) - label_axis(other);
      const double way = points_[nodes.back()][axis] - points_[nodes.front()][axis];
      if (mine < other) count_reversals(nodes, axis, first);
      if (std::abs(way) < noise_ * 0.25) known = false;
      Vec3 d = Vec3::Zero();
      d[axis] = way < 0 ? -1 : 1;
      directions.push_back(d);
    }
    const int chart = chart_[dart_left(g_, loop.front())];
    ++loops_[chart];
    if (!known || directions.size() < 4) {
      unknown_[chart] = 1;
      return;
    }
    for (std::size_t i = 0; i < directions.size(); ++i) {
      turns_[chart] += static_cast<int>(std::lround(directions[i].cross(directions[(i + 1) % directions.size()]).dot(label_vector(mine))));
    }
  }

  // Each boundary is seen from both sides; the caller counts it from one.
  void count_reversals(const std::vector<int>& nodes, int axis, int dart) {
    const double sign = points_[nodes.back()][axis] >= points_[nodes.front()][axis] ? 1 : -1;
    double extreme = sign * points_[nodes.front()][axis];
    bool back = false;
    for (int n : nodes) {
      const double x = sign * points_[n][axis];
      if (x > extreme) {
        extreme = x;
        back = false;
      } else if (!back && extreme - x > noise_) {
        ++result_.turning_points;
        blame(dart);
        back = true;
      }
    }
  }

  const RegionGraph& g_;
  const std::vector<Vec3>& points_;
  const std::vector<int>& label_;
  double noise_;
  std::vector<char> corner_;
  std::vector<int> chart_;                   // per region: the least region of its chart
  std::vector<int> turns_, loops_, unknown_; // per chart
  std::set<int> hit_;
  Violations result_;
};

}  // namespace

Violations find_violations(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& region_label, double noise) {
  return Checker(graph, points, region_label, noise).run();
}

}  // namespace polycube
