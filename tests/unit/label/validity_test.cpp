#include "label/validity.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "core/charts.h"

namespace polycube {
namespace {

// The boundary of a union of unit voxels as triangles; its charts are the regions and CAD faces.
struct Voxels {
  TetMesh mesh;             // boundary only
  std::vector<int> region;  // per triangle
  std::vector<int> label;   // per region
};

Voxels voxels(const std::vector<std::array<int, 3>>& cells, int divisions = 2) {
  Voxels v;
  std::map<std::array<int, 3>, int> point;
  std::vector<int> triangle_label;
  const auto filled = [&](std::array<int, 3> c) { return std::find(cells.begin(), cells.end(), c) != cells.end(); };
  const auto at = [&](std::array<int, 3> p) {
    const auto [it, fresh] = point.try_emplace(p, static_cast<int>(v.mesh.points.size()));
    if (fresh) v.mesh.points.emplace_back(Vec3(p[0], p[1], p[2]) / divisions);
    return it->second;
  };
  for (const auto& c : cells) {
    for (int label = 0; label < 6; ++label) {
      const int axis = label / 2, side = label % 2 == 0;
      std::array<int, 3> n = c;
      n[axis] += side ? 1 : -1;
      if (filled(n)) continue;
      const int plane = c[axis] + side;
      const int b = (axis + 1) % 3, d = (axis + 2) % 3;
      for (int i = 0; i < divisions; ++i) {
        for (int j = 0; j < divisions; ++j) {
          std::array<int, 4> q{};
          for (int k = 0; k < 4; ++k) {
            std::array<int, 3> p{};
            p[axis] = plane * divisions;
            p[b] = c[b] * divisions + i + (k == 1 || k == 2);
            p[d] = c[d] * divisions + j + (k >= 2);
            q[k] = at(p);
          }
          if (!side) std::swap(q[1], q[3]);
          for (const Triangle& t : {Triangle{q[0], q[1], q[2]}, Triangle{q[0], q[2], q[3]}}) {
            v.mesh.triangles.push_back(t);
            triangle_label.push_back(label);
          }
        }
      }
    }
  }
  v.region.resize(v.mesh.triangles.size());
  for (const Chart& c : find_charts(v.mesh.triangles, triangle_label)) {
    for (int t : c.triangles) v.region[t] = static_cast<int>(v.label.size());
    v.label.push_back(triangle_label[c.triangles.front()]);
  }
  for (int r : v.region) v.mesh.triangle_face.push_back(r + 1);
  return v;
}

Violations violations(const Voxels& v, const std::vector<int>& label) {
  return find_violations(build_region_graph(v.mesh, v.region), v.mesh.points, label, 0.1);
}

const std::vector<std::vector<std::array<int, 3>>> kPolycubes{
    {{0, 0, 0}},
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}},
    {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 1}, {1, 1, 1}},
};

TEST(Validity, PolycubesAreValidAndMonotone) {
  for (const auto& cells : kPolycubes) {
    const Voxels v = voxels(cells);
    const Violations found = violations(v, v.label);
    EXPECT_EQ(found.score, 0) << cells.size() << " voxels";
    EXPECT_TRUE(found.regions.empty());
  }
}

TEST(Validity, AnyOtherLabelOfOneRegionOfACubeIsFound) {
  const Voxels v = voxels({{0, 0, 0}});
  for (std::size_t r = 0; r < v.label.size(); ++r) {
    for (int l = 0; l < 6; ++l) {
      std::vector<int> wrong = v.label;
      if (wrong[r] == l) continue;
      wrong[r] = l;
      EXPECT_GT(violations(v, wrong).score, 0) << "region " << r << " label " << l;
    }
  }
}

TEST(Validity, ARegionThatFacesAwayFromItsLabelFoldsWhereItsNormalIsKnown) {
  const Voxels v = voxels({{0, 0, 0}});
  RegionGraph g = build_region_graph(v.mesh, v.region);
  EXPECT_EQ(find_violations(g, v.mesh.points, v.label, 0.1).folded_regions, 0);
  for (std::size_t r = 0; r < g.regions.size(); ++r) {
    const Vec3 own = label_sign(v.label[r]) * Vec3::Unit(label_axis(v.label[r])), other = own.cross(Vec3(1, 2, 3)).normalized();
    for (const double degrees : {0.0, 45.0, 80.0, 89.0, 90.0, 180.0}) {
      const double angle = degrees * std::numbers::pi / 180;
      g.regions[r].normal = std::cos(angle) * own + std::sin(angle) * other;
      const Violations found = find_violations(g, v.mesh.points, v.label, 0.1);
      EXPECT_EQ(found.folded_regions, degrees > 85 ? 1 : 0) << degrees;
      EXPECT_EQ(found.score > 0, degrees > 85);
      EXPECT_TRUE(found.valid());
      EXPECT_EQ(found.sound(), degrees < 85);
      EXPECT_EQ(found.regions.size(), degrees > 85 ? 5u : 0u);  // it and the four beside it
    }
    g.regions[r].normal.setZero();
  }
}

TEST(Validity, FoldedPartsOfFacesAreCountedOnTheTriangles) {
  const Voxels v = voxels({{0, 0, 0}});
  std::vector<int> labels;
  for (int r : v.region) labels.push_back(v.label[r]);
  EXPECT_EQ(count_folded_parts(v.mesh, Mat3::Identity(), labels), 0);
  for (int& l : labels) l = l == 4 ? 0 : l;  // the top joins the side +X
  EXPECT_EQ(count_folded_parts(v.mesh, Mat3::Identity(), labels), 1);
  const Mat3 turned = Eigen::AngleAxisd(std::numbers::pi / 4, Vec3::UnitY()).toRotationMatrix();  // one way both face half way between
  EXPECT_EQ(count_folded_parts(v.mesh, turned, labels) + count_folded_parts(v.mesh, turned.transpose(), labels), 1);
}

TEST(Validity, ABoundaryThatGoesDownAndUpAgainHasATurningPoint) {
  // All three inner faces of a U take the label of its left inner wall: the side's boundary then goes down one wall and up the other.
  const Voxels v = voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}});
  std::vector<int> wrong = v.label;
  const RegionGraph g = build_region_graph(v.mesh, v.region);
  int changed = 0;
  for (std::size_t r = 0; r < wrong.size(); ++r) {
    Vec3 centre = Vec3::Zero();
    for (int n : v.mesh.triangles[g.regions[r].triangles[0]]) centre += v.mesh.points[n] / 3;
    const bool inside = centre[0] > 0.9 && centre[0] < 2.1 && centre[2] > 0.9;
    if (!inside || wrong[r] == 2 || wrong[r] == 3) continue;
    wrong[r] = 0;
    ++changed;
  }
  ASSERT_EQ(changed, 3);
  EXPECT_GT(violations(v, wrong).turning_points, 0);
}

TEST(Validity, ATipBetweenCadEdgesIsATurningPointHoweverShort) {
  // The same U, its floor sloping down to the middle, and all of it far smaller than what counts elsewhere.
  Voxels v = voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}});
  std::vector<int> wrong = v.label;
  const RegionGraph plain = build_region_graph(v.mesh, v.region);
  for (std::size_t r = 0; r < wrong.size(); ++r) {
    Vec3 centre = Vec3::Zero();
    for (int n : v.mesh.triangles[plain.regions[r].triangles[0]]) centre += v.mesh.points[n] / 3;
    if (centre[0] > 0.9 && centre[0] < 2.1 && centre[2] > 0.9 && wrong[r] != 2 && wrong[r] != 3) wrong[r] = 0;
  }
  for (Vec3& p : v.mesh.points) {
    if (p[0] == 1.5 && p[2] == 1) p[2] = 0.4;
    p *= 0.01;
  }
  EXPECT_EQ(find_violations(plain, v.mesh.points, wrong, 0.1).turning_points, 0);
  v.mesh.point_cad.assign(v.mesh.points.size(), {2, 1});
  for (const Arc& arc : plain.arcs) {
    for (int n : arc.nodes) v.mesh.point_cad[n] = {1, 1};
  }
  const RegionGraph cad = build_region_graph(v.mesh, v.region);
  EXPECT_GT(find_violations(cad, v.mesh.points, wrong, 0.1).turning_points, 0);
}

TEST(Validity, AllAlongTheWayBackIsToBlameForATurningPoint) {
  // The same U with one arm longer, so that it is clear which way its boundary should go.
  const Voxels v = voxels({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {2, 0, 1}, {2, 0, 2}});
  std::vector<int> wrong = v.label;
  const RegionGraph g = build_region_graph(v.mesh, v.region);
  std::set<int> inner;
  for (std::size_t r = 0; r < wrong.size(); ++r) {
    Vec3 centre = Vec3::Zero();
    for (int n : v.mesh.triangles[g.regions[r].triangles[0]]) centre += v.mesh.points[n] / 3;
    if (centre[0] < 0.9 || centre[0] > 2.1 || centre[2] < 0.9 || wrong[r] == 2 || wrong[r] == 3) continue;
    wrong[r] = 0;
    inner.insert(static_cast<int>(r));
  }
  const Violations found = violations(v, wrong);
  EXPECT_GT(found.turning_points, 0);
  for (int r : inner) EXPECT_TRUE(std::binary_search(found.regions.begin(), found.regions.end(), r)) << r;
}

// A border of charts on a flat side of the part: two corners at its ends.
TEST(Validity, CornersWhereAPartIsSmooth) {
  const Voxels v = voxels({{0, 0, 0}, {1, 0, 0}}, 3);
  std::vector<int> label(v.mesh.triangles.size());
  for (std::size_t t = 0; t < label.size(); ++t) label[t] = v.label[v.region[t]];
  EXPECT_TRUE(smooth_corners(v.mesh, Mat3::Identity(), label).empty());
  // The upper side's right half faces to the right, as a bent face's would.
  for (std::size_t t = 0; t < label.size(); ++t) {
    const auto& [a, b, c] = v.mesh.triangles[t];
    if (label[t] == 4 && (v.mesh.points[a] + v.mesh.points[b] + v.mesh.points[c]).x() > 3) label[t] = 0;
  }
  const std::vector<int> corners = smooth_corners(v.mesh, Mat3::Identity(), label);
  ASSERT_EQ(corners.size(), 2u);
  for (const int n : corners) {
    EXPECT_NEAR(v.mesh.points[n].x(), 1, 1e-12);
    EXPECT_NEAR(v.mesh.points[n].z(), 1, 1e-12);
  }
}

TEST(RegionGraph, ArcsAndJunctionsOfACube) {
  const Voxels v = voxels({{0, 0, 0}}, 3);
  const RegionGraph g = build_region_graph(v.mesh, v.region);
  EXPECT_EQ(g.regions.size(), 6u);
  EXPECT_EQ(g.arcs.size(), 12u);
  EXPECT_EQ(g.junctions.size(), 8u);
  for (const Junction& j : g.junctions) EXPECT_EQ(j.darts.size(), 3u);
  for (const Arc& a : g.arcs) {
    EXPECT_EQ(a.nodes.size(), 4u);
    EXPECT_NEAR(a.length, 1, 1e-12);
    EXPECT_NEAR(a.angle, M_PI / 2, 1e-9);
  }
  for (const Region& r : g.regions) EXPECT_NEAR(r.area, 1, 1e-12);
}

}  // namespace
}  // namespace polycube
