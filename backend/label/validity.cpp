#include "label/validity.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <set>

#include "core/charts.h"
#include "core/union_find.h"
#include "label/tuning.h"

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

// Base 7, so that short sequences fit in one number.
std::int64_t code_of(const std::vector<int>& s) {
  std::int64_t code = 0;
  for (int l : s) code = 7 * code + l + 1;
  return code;
}

bool is_polycube_corner(const std::vector<int>& labels) {
  // All spellings of every corner, ascending.
  static const std::vector<std::int64_t> kCodes = [] {
    std::vector<std::int64_t> codes;
    for (std::vector<int> corner : polycube_corners()) {
      for (std::size_t i = 0; i < corner.size(); ++i) {
        codes.push_back(code_of(corner));
        std::rotate(corner.begin(), corner.begin() + 1, corner.end());
      }
    }
    std::sort(codes.begin(), codes.end());
    return codes;
  }();
  constexpr std::size_t kLongest = 12;  // no corner has as many
  return labels.size() <= kLongest && std::binary_search(kCodes.begin(), kCodes.end(), code_of(labels));
}

// `normal`: of any length; zero where it is not known.
bool folds(const Vec3& normal, int label) { return normal.dot(label_vector(label)) < kLabelTuning.least_facing * normal.norm(); }

}  // namespace

/// The check of one labelling.
class ViolationFinder::Check {
 public:
  Check(const ViolationFinder& finder, const std::vector<int>& label) : f_(finder), g_(finder.graph_), label_(label), hit_(finder.graph_.regions.size(), 0) {}

  Violations run() {
    check_arcs();
    check_junctions();
    find_charts();
    check_loops();
    check_turns();
    check_folds();
    for (std::size_t r = 0; r < hit_.size(); ++r) {
      if (hit_[r]) result_.regions.push_back(static_cast<int>(r));
    }
    result_.score = 10.0 * result_.opposite_arcs + 10.0 * result_.poor_loops + 6.0 * result_.bad_corners + 3.0 * result_.turning_points +
                    6.0 * result_.bad_turns + kLabelTuning.fold_score * result_.folded_regions;
    return std::move(result_);
  }

 private:
  bool border(int dart) const { return label_[g_.arcs[dart / 2].left] != label_[g_.arcs[dart / 2].right]; }
  int start_of(int dart) const { return dart % 2 == 0 ? g_.arcs[dart / 2].start : g_.arcs[dart / 2].end; }
  int end_of(int dart) const { return start_of(dart ^ 1); }

  void blame(int dart) {
    hit_[g_.arcs[dart / 2].left] = 1;
    hit_[g_.arcs[dart / 2].right] = 1;
  }

  void check_arcs() {
    for (int a = 0; a < static_cast<int>(g_.arcs.size()); ++a) {
      const int p = label_[g_.arcs[a].left], q = label_[g_.arcs[a].right];
      if (p == q || label_axis(p) != label_axis(q)) continue;
      ++result_.opposite_arcs;
      blame(2 * a);
    }
  }

  void check_folds() {
    std::vector<char> folded(g_.regions.size());
    for (std::size_t r = 0; r < folded.size(); ++r) {
      folded[r] = f_.folds_[r][static_cast<std::size_t>(label_[r])];
      result_.folded_regions += folded[r];
    }
    if (result_.folded_regions == 0) return;
    // What stands beside it forced it there.
    for (const Arc& a : g_.arcs) {
      if (!folded[a.left] && !folded[a.right]) continue;
      hit_[a.left] = 1;
      hit_[a.right] = 1;
    }
  }

  void check_junctions() {
    corner_.assign(g_.junctions.size(), 0);
    std::vector<int> around;
    for (std::size_t j = 0; j < g_.junctions.size(); ++j) {
      around.clear();
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
    UnionFind charts(g_.regions.size());
    for (const Arc& a : g_.arcs) {
      if (label_[a.left] == label_[a.right]) charts.unite(a.left, a.right);
    }
    chart_.resize(g_.regions.size());
    for (std::size_t r = 0; r < chart_.size(); ++r) chart_[r] = charts.find(static_cast<int>(r));
    turns_.assign(g_.regions.size(), 0);
    loops_.assign(g_.regions.size(), 0);
    unknown_.assign(g_.regions.size(), 0);
  }

  // A rectilinear polygon turns left four times more than right, a hole's border right; so turns tell of a chart that is inside out, and of one
  // without any border.
  void check_turns() {
    std::vector<char> bad(g_.regions.size(), 0);
    for (std::size_t r = 0; r < g_.regions.size(); ++r) {
      if (chart_[r] != static_cast<int>(r) || unknown_[r] || (loops_[r] > 0 && turns_[r] == 4 * (2 - loops_[r]))) continue;
      ++result_.bad_turns;
      if (loops_[r] == 0) result_.poor_loops += 6;  // the whole surface is one chart: it lacks the borders of a cube's six
      bad[r] = 1;
    }
    for (std::size_t r = 0; r < g_.regions.size(); ++r) {
      if (bad[chart_[r]]) hit_[r] = 1;
    }
  }

  // The border dart that follows with the same chart on the left.
  int next(int dart) const {
    const auto& darts = g_.junctions[end_of(dart)].darts;
    auto i = static_cast<std::size_t>(f_.place_[dart ^ 1]);
    // Turning clockwise from the way back sweeps over the left side.
    do {
      i = (i + darts.size() - 1) % darts.size();
    } while (!border(darts[i]));
    return darts[i];
  }

  void check_loops() {
    std::vector<char> seen(2 * g_.arcs.size(), 0);
    std::vector<int> loop;
    for (int first = 0; first < static_cast<int>(2 * g_.arcs.size()); ++first) {
      if (seen[first] || !border(first)) continue;
      if (start_of(first) < 0) {  // a closed chain without junction
        seen[first] = 1;
        result_.poor_loops += 4;
        unknown_[chart_[dart_left(g_, first)]] = 1;
        blame(first);
        continue;
      }
      loop.clear();
      for (int d = first; !seen[d]; d = next(d)) {
        seen[d] = 1;
        loop.push_back(d);
      }
      check_loop(loop);
    }
  }

  void check_loop(std::vector<int>& loop) {
    std::size_t corners = 0, first_corner = 0;
    for (std::size_t i = loop.size(); i-- > 0;) {
      if (!corner_[start_of(loop[i])]) continue;
      ++corners;
      first_corner = i;
    }
    const int chart = chart_[dart_left(g_, loop.front())];
    if (corners < 4) {
      result_.poor_loops += 4 - static_cast<int>(corners);
      for (int d : loop) blame(d);
      if (corners == 0) {
        unknown_[chart] = 1;
        return;
      }
    }
    // The boundaries between consecutive corners, as axis directions of the polygon that the chart becomes.
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(first_corner), loop.end());
    directions_.clear();
    bool known = true;
    const int mine = label_[dart_left(g_, loop.front())];
    for (std::size_t i = 0; i < loop.size();) {
      const std::size_t start = i;
      do {
        ++i;
      } while (i < loop.size() && !corner_[start_of(loop[i])]);
      const int other = label_[dart_right(g_, loop[start])];
      if (label_axis(mine) == label_axis(other)) {
        known = false;
        continue;
      }
      const int axis = 3 - label_axis(mine) - label_axis(other);
      const double way = value_at(loop[i - 1] ^ 1, axis) - value_at(loop[start], axis);
      // Each boundary is seen from both sides.
      if (mine < other) count_reversals(loop, start, i, axis, way >= 0 ? 1 : -1);
      if (std::abs(way) < f_.noise_ * 0.25) known = false;
      Vec3 d = Vec3::Zero();
      d[axis] = way < 0 ? -1 : 1;
      directions_.push_back(d);
    }
    ++loops_[chart];
    if (!known || directions_.size() < 4) {
      unknown_[chart] = 1;
      return;
    }
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      turns_[chart] += static_cast<int>(std::lround(directions_[i].cross(directions_[(i + 1) % directions_.size()]).dot(label_vector(mine))));
    }
  }

  double value_at(int dart, int axis) const {
    const Course& course = f_.course_[dart / 2][axis];
    return dart % 2 == 0 ? course.front().x : course.back().x;
  }

  // Along the darts [first, last) of a loop. To blame is what lies beside the boundary where it goes back.
  void count_reversals(const std::vector<int>& loop, std::size_t first, std::size_t last, int axis, double sign) {
    double high = sign * value_at(loop[first], axis), low = high, before = high;
    bool counted = false, tip = false, was_forward = true, was_steep = false;
    std::size_t turn = first, at = first;
    const auto count_if_far = [&] {
      if (counted || high - low <= (tip ? kLabelTuning.real_share : 1) * f_.noise_) return;
      ++result_.turning_points;
      for (std::size_t i = turn; i <= at; ++i) blame(loop[i]);
      counted = true;
    };
    const auto pass = [&](double value, bool steep) {
      const double x = sign * value;
      if (x == before) return;  // the end of one dart is the start of the next
      const bool forward = x > before;
      tip = tip || (forward != was_forward && steep && was_steep);
      low = std::min(low, x);
      count_if_far();
      if (x > high) {
        high = low = x;
        counted = tip = false;
        turn = at;
      }
      before = x;
      was_forward = forward;
      was_steep = steep;
    };
    for (; at < last; ++at) {
      const Course& course = f_.course_[loop[at] / 2][axis];
      const std::size_t count = course.size();
      for (std::size_t i = 0; i < count; ++i) {
        if (loop[at] % 2 == 0) {
          pass(course[i].x, course[i].steep);
        } else {
          pass(course[count - 1 - i].x, i > 0 && course[count - i].steep);
        }
      }
    }
  }

  const ViolationFinder& f_;
  const RegionGraph& g_;
  const std::vector<int>& label_;
  std::vector<char> corner_;
  std::vector<int> chart_;                    // per region: the least region of its chart
  std::vector<int> turns_, loops_, unknown_;  // per chart
  std::vector<Vec3> directions_;
  std::vector<char> hit_;  // per region
  Violations result_;
};

ViolationFinder::Course ViolationFinder::course(const std::vector<Vec3>& points, const Arc& arc, int axis) {
  Course result{{points[arc.nodes.front()][axis], false}};
  for (std::size_t i = 1; i < arc.nodes.size(); ++i) {
    const Vec3 step = points[arc.nodes[i]] - points[arc.nodes[i - 1]];
    Place place{points[arc.nodes[i]][axis], arc.cad_dim[i - 1] < 2 && arc.cad_dim[i] < 2 && std::abs(step[axis]) > kLabelTuning.steep * step.norm()};
    const std::size_t n = result.size();
    if (n > 1 && (result[n - 1].x - result[n - 2].x) * (place.x - result[n - 1].x) >= 0) {  // what lies between two places reverses nothing
      place.steep = place.steep || result[n - 1].steep;
      result.pop_back();
    }
    result.push_back(place);
  }
  return result;
}

ViolationFinder::ViolationFinder(const RegionGraph& graph, const std::vector<Vec3>& points, double noise)
    : graph_(graph), noise_(noise), place_(2 * graph.arcs.size(), -1) {
  for (const Arc& a : graph.arcs) course_.push_back({course(points, a, 0), course(points, a, 1), course(points, a, 2)});
  for (const Junction& j : graph.junctions) {
    for (std::size_t i = 0; i < j.darts.size(); ++i) place_[j.darts[i]] = static_cast<int>(i);
  }
  for (const Region& r : graph.regions) {
    folds_.emplace_back();
    for (int l = 0; l < 6; ++l) folds_.back()[static_cast<std::size_t>(l)] = folds(r.normal, l) ? 1 : 0;
  }
}

Violations ViolationFinder::find(const std::vector<int>& region_label) const { return Check(*this, region_label).run(); }

double ViolationFinder::score(const std::vector<int>& region_label) const { return Check(*this, region_label).run().score; }

Violations find_violations(const RegionGraph& graph, const std::vector<Vec3>& points, const std::vector<int>& region_label, double noise) {
  return ViolationFinder(graph, points, noise).find(region_label);
}

ChartGraph chart_graph(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels) {
  ChartGraph result;
  std::vector<int> chart_of(labels.size());
  const std::vector<Chart> charts = find_charts(mesh.triangles, labels);
  for (std::size_t c = 0; c < charts.size(); ++c) {
    result.label.push_back(labels[charts[c].triangles.front()]);
    for (int t : charts[c].triangles) chart_of[t] = static_cast<int>(c);
  }
  for (const Vec3& p : mesh.points) result.points.push_back(frame * p);
  double edge = 0;
  for (const Triangle& t : mesh.triangles) edge += (result.points[t[0]] - result.points[t[1]]).norm() / static_cast<double>(mesh.triangles.size());
  result.noise = 0.75 * edge;
  result.graph = build_region_graph(mesh, chart_of);
  return result;
}

Violations find_violations(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels) {
  const ChartGraph c = chart_graph(mesh, frame, labels);
  return find_violations(c.graph, c.points, c.label, c.noise);
}

std::vector<int> smooth_corners(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels) {
  const ChartGraph charts = chart_graph(mesh, frame, labels);
  const RegionGraph& g = charts.graph;
  const auto smooth = [&](int dart) { return std::abs(g.arcs[dart / 2].angle - std::numbers::pi) < kLabelTuning.sharp_bend; };
  std::vector<int> nodes;
  for (const Junction& j : g.junctions) {
    if (std::any_of(j.darts.begin(), j.darts.end(), smooth)) nodes.push_back(j.node);
  }
  return nodes;
}

int count_folded_parts(const TetMesh& mesh, const Mat3& frame, const std::vector<int>& labels) {
  struct Part {
    Vec3 facing = Vec3::Zero();  // the normal times the area
    double area = 0;
  };
  std::map<std::pair<int, int>, Part> parts;  // of CAD face and label
  std::map<int, double> face_area;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 normal = frame * (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]) / 2;
    Part& part = parts[{mesh.triangle_face[t], labels[t]}];
    part.facing += normal;
    part.area += normal.norm();
    face_area[mesh.triangle_face[t]] += normal.norm();
  }
  return static_cast<int>(std::count_if(parts.begin(), parts.end(), [&](const auto& entry) {
    const auto& [key, part] = entry;
    return part.area > kLabelTuning.sliver * face_area[key.first] && folds(part.facing, key.second);
  }));
}

}  // namespace polycube
