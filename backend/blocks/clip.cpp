#include "blocks/clip.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "blocks/topology.h"

namespace polycube {

void TetClipper::load(const std::array<Vec3, 4>& corners) {
  points_.assign(corners.begin(), corners.end());
  whole_.clear();
  for (int f = 0; f < 4; ++f) {
    for (int v : kTetFacets[f]) whole_.loops.push_back(v);
    whole_.close_face(f);
  }
}

int TetClipper::crossing(int below, int above, int axis, double value) {
  for (const auto& cut : cuts_) {
    if (cut[0] == below && cut[1] == above) return cut[2];
  }
  const Vec3& a = points_[below];
  const Vec3& b = points_[above];
  const double t = (value - a[axis]) / (b[axis] - a[axis]);
  Vec3 p;
  for (int d = 0; d < 3; ++d) p[d] = std::clamp(a[d] + t * (b[d] - a[d]), std::min(a[d], b[d]), std::max(a[d], b[d]));
  p[axis] = value;
  const int index = static_cast<int>(points_.size());
  points_.push_back(p);
  cuts_.push_back({below, above, index});
  return index;
}

void TetClipper::split(const Polyhedron& in, int axis, double value, Polyhedron& below, Polyhedron& above) {
  below.clear();
  above.clear();
  cuts_.clear();
  next_.clear();
  const int faces = static_cast<int>(in.tags.size());
  for (int f = 0; f < faces; ++f) {
    const int begin = in.starts[f], end = in.starts[f + 1];
    int first_in = -1, out = -1;
    const auto entered = [&](int in_point) { next_.push_back({in_point, out}); };
    for (int i = begin; i < end; ++i) {
      const int a = in.loops[i], b = in.loops[i + 1 < end ? i + 1 : begin];
      const bool a_below = points_[a][axis] <= value, b_below = points_[b][axis] <= value;
      (a_below ? below : above).loops.push_back(a);
      if (a_below == b_below) continue;
      const int m = a_below ? crossing(a, b, axis, value) : crossing(b, a, axis, value);
      below.loops.push_back(m);
      above.loops.push_back(m);
      if (a_below) {
        out = m;
      } else if (out < 0) {
        first_in = m;
      } else {
        entered(m);
        out = -1;
      }
    }
    if (first_in >= 0) entered(first_in);
    if (static_cast<int>(below.loops.size()) > below.starts.back()) below.close_face(in.tags[f]);
    if (static_cast<int>(above.loops.size()) > above.starts.back()) above.close_face(in.tags[f]);
  }
  // The outline of the cut is a cycle; rounding can pinch it into several.
  while (!next_.empty()) {
    const std::size_t start = below.loops.size();
    int at = next_.front()[0];
    for (;;) {
      const auto edge = std::find_if(next_.begin(), next_.end(), [&](const auto& e) { return e[0] == at; });
      if (edge == next_.end()) break;
      below.loops.push_back(at);
      at = (*edge)[1];
      next_.erase(edge);
    }
    above.loops.insert(above.loops.end(), below.loops.rbegin(), below.loops.rbegin() + static_cast<std::ptrdiff_t>(below.loops.size() - start));
    below.close_face(4 + 2 * axis + 1);
    above.close_face(4 + 2 * axis);
  }
}

double TetClipper::volume6(const Polyhedron& p) const {
  if (p.tags.empty()) return 0;
  const Vec3& origin = points_[p.loops[0]];
  double sum = 0;
  for (std::size_t f = 0; f < p.tags.size(); ++f) {
    const Vec3 a = points_[p.loops[p.starts[f]]] - origin;
    for (int i = p.starts[f] + 1; i + 1 < p.starts[f + 1]; ++i) {
      sum += a.dot((points_[p.loops[i]] - origin).cross(points_[p.loops[i + 1]] - origin));
    }
  }
  return sum;
}

double TetClipper::area2(const Polyhedron& p, int face, int axis) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3& origin = points_[p.loops[p.starts[face]]];
  double sum = 0;
  for (int i = p.starts[face] + 1; i + 1 < p.starts[face + 1]; ++i) {
    const Vec3 a = points_[p.loops[i]] - origin, b = points_[p.loops[i + 1]] - origin;
    sum += a[u] * b[v] - a[v] * b[u];
  }
  return sum;
}

}  // namespace polycube
