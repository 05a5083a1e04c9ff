#include "label/order.h"

#include <gtest/gtest.h>

#include <map>

#include "core/charts.h"

namespace polycube {
namespace {

/// The surface of unit cells as two triangles a side, each labelled as it faces.
struct Surface {
  TetMesh mesh;
  std::vector<int> label;
};

Surface surface(const std::vector<std::array<int, 3>>& cells) {
  Surface s;
  std::map<std::array<int, 3>, int> point;
  const auto filled = [&](const std::array<int, 3>& c) { return std::find(cells.begin(), cells.end(), c) != cells.end(); };
  for (const auto& c : cells) {
    for (int label = 0; label < 6; ++label) {
      const int axis = label / 2, side = label % 2 == 0;
      std::array<int, 3> next = c;
      next[axis] += side ? 1 : -1;
      if (filled(next)) continue;
      std::array<int, 4> quad{};
      for (int k = 0; k < 4; ++k) {
        std::array<int, 3> p = c;
        p[axis] += side;
        p[(axis + 1) % 3] += k == 1 || k == 2;
        p[(axis + 2) % 3] += k >= 2;
        const auto [it, fresh] = point.try_emplace(p, static_cast<int>(s.mesh.points.size()));
        if (fresh) s.mesh.points.emplace_back(p[0], p[1], p[2]);
        quad[k] = it->second;
      }
      if (!side) std::swap(quad[1], quad[3]);
      s.mesh.triangles.push_back({quad[0], quad[1], quad[2]});
      s.mesh.triangles.push_back({quad[0], quad[2], quad[3]});
      s.label.insert(s.label.end(), 2, label);
    }
  }
  s.mesh.triangle_face.assign(s.mesh.triangles.size(), 1);
  return s;
}

RisingLoop loop_of(const Surface& s) {
  const std::vector<Chart> charts = find_charts(s.mesh.triangles, s.label);
  std::vector<int> chart(s.label.size()), label;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    for (int t : charts[c].triangles) chart[t] = static_cast<int>(c);
    label.push_back(s.label[charts[c].triangles.front()]);
  }
  RisingLoop loop = find_rising_loop(build_region_graph(s.mesh, chart), s.mesh.points, label, 0.1);
  for (int& c : loop.charts) c = label[c];
  return loop;
}

// A ring of eight cells with a ninth on top of one of them.
const std::vector<std::array<int, 3>> kRing{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}, {1, 0, 1}};

TEST(RisingLoop, APolycubeHasNone) { EXPECT_TRUE(loop_of(surface(kRing)).charts.empty()); }

TEST(RisingLoop, ARampThatEndsWhereItBeginsIsFound) {
  Surface s = surface(kRing);
  // One side of the ninth cell becomes the ramp that leads up to it.
  for (std::size_t t = 0; t < s.label.size(); ++t) {
    double low = 9;
    for (int n : s.mesh.triangles[t]) low = std::min(low, s.mesh.points[n][2]);
    if (s.label[t] == 0 && low > 0.5) s.label[t] = 4;
  }
  const RisingLoop loop = loop_of(s);
  EXPECT_EQ(loop.axis, 2);
  EXPECT_EQ(loop.charts, std::vector<int>{4});  // +Z over itself
}

}  // namespace
}  // namespace polycube
