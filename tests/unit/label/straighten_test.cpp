#include "label/straighten.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "support/tet_grid.h"

namespace polycube {
namespace {

/// A cube of 6 x 6 x 6 cells, classified; its upper side (face 5) is cut into regions 10 and 11 at x = 3, its front (face 4, y = 0) into 20 and 21; the
/// other sides are one region each.
struct Cube {
  TetMesh mesh = tet_grid(6, 6, 6);
  std::vector<int> region;
  int rim = 3 + 7 * 7 * 6;  // where both borders end before the cut: (3, 0, 6)

  Cube() {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const int face = mesh.triangle_face[t];
      double x = 0;
      for (int n : mesh.triangles[t]) {
        x += mesh.points[n][0] / 3;
        CadRef& cad = mesh.point_cad[n];
        if (cad.dim == 3) cad = {2, face};
      }
      region.push_back(face == 5 ? 10 + (x > 3) : face == 4 ? 20 + (x > 3) : face);
    }
    // CAD edges along x at both ends of the borders on the upper side, and at the lower end of those in front.
    for (const auto& [edge, first] : {std::pair{1, 7 * 7 * 6}, std::pair{2, 7 * 6 + 7 * 7 * 6}, std::pair{3, 0}}) {
      for (int i = 0; i <= 6; ++i) {
        const int n = i + first;
        mesh.point_cad[n] = i == 0 || i == 6 ? CadRef{0, 10 * edge + i} : CadRef{1, edge};
        if (i == 0) continue;
        mesh.segments.push_back({n - 1, n});
        mesh.segment_edge.push_back(edge);
      }
    }
  }
  BorderFunction border(int low, double at) const {
    return {low + 1, low, [this, at](int n) { return mesh.points[n][0] - at; }, {rim}};
  }
  // The x coordinates of the points between two regions.
  std::set<double> between(const std::vector<int>& regions, int low) const {
    std::set<int> left, right;
    for (std::size_t t = 0; t < regions.size(); ++t) {
      if (regions[t] != low && regions[t] != low + 1) continue;
      for (int n : mesh.triangles[t]) (regions[t] == low ? left : right).insert(n);
    }
    std::set<double> x;
    for (int n : left) {
      if (right.count(n) > 0) x.insert(std::round(mesh.points[n][0] * 1e9) / 1e9);
    }
    return x;
  }
};

double volume(const TetMesh& m) {
  double sum = 0;
  for (const Tet& t : m.tets) {
    const double v = (m.points[t[1]] - m.points[t[0]]).cross(m.points[t[2]] - m.points[t[0]]).dot(m.points[t[3]] - m.points[t[0]]) / 6;
    EXPECT_GT(v, 0);
    sum += v;
  }
  return sum;
}

TEST(CutAlong, BordersAreStraightWhetherPointsAreSplitOrMoved) {
  for (const double at : {3.1, 3.4, 2.9, 3.0}) {
    Cube cube;
    const std::vector<int> regions = cut_along(cube.mesh, cube.region, {cube.border(10, at)}, Monitor());
    EXPECT_EQ(cube.between(regions, 10), std::set<double>{at});
    EXPECT_NEAR(volume(cube.mesh), 216, 1e-9);
  }
}

// A tet so flat that the point on the surface, (3, 3, 6), cannot be moved onto the border: it would be turned inside out.
void hold_a_point(TetMesh& mesh) {
  const int held = 3 + 7 * 3 + 7 * 7 * 6;
  const auto six_volumes = [&](const Tet& t) {
    return (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]).dot(mesh.points[t[3]] - mesh.points[t[0]]);
  };
  const auto sound = [&] { return std::all_of(mesh.tets.begin(), mesh.tets.end(), [&](const Tet& t) { return six_volumes(t) > 0; }); };
  for (const Tet& tet : mesh.tets) {
    if (std::find(tet.begin(), tet.end(), held) == tet.end()) continue;
    for (int inner : tet) {
      if (mesh.point_cad[inner].dim != 3) continue;
      std::vector<Vec3> others;
      for (int n : tet) {
        if (n != inner) others.push_back(mesh.points[n]);
      }
      const Vec3 before = mesh.points[inner], normal = (others[1] - others[0]).cross(others[2] - others[0]).normalized();
      mesh.points[inner] -= 0.99 * (before - others[0]).dot(normal) * normal;
      if (sound()) {
        mesh.points[held][0] += 0.1;
        const bool is_held = !sound();
        mesh.points[held][0] -= 0.1;
        if (is_held) return;
      }
      mesh.points[inner] = before;
    }
  }
  FAIL() << "no tet can be flattened";
}

TEST(CutAlong, ABorderPassesBesideAPointThatCannotBeMoved) {
  Cube cube;
  hold_a_point(cube.mesh);
  const std::vector<int> regions = cut_along(cube.mesh, cube.region, {cube.border(10, 3.1)}, Monitor());
  EXPECT_EQ(cube.between(regions, 10), std::set<double>{3.1});
  volume(cube.mesh);
}

TEST(CutAlong, BordersOfTwoFacesThatEndTogetherStillDo) {
  Cube cube;
  const std::vector<int> regions = cut_along(cube.mesh, cube.region, {cube.border(10, 3.1), cube.border(20, 3.45)}, Monitor());
  EXPECT_EQ(cube.between(regions, 10), std::set<double>{3.1});
  const std::set<double> front = cube.between(regions, 20);
  EXPECT_NEAR(*front.begin(), 3.1, 1e-6);    // bent towards the other's end
  EXPECT_NEAR(*front.rbegin(), 3.45, 1e-6);  // where it belongs farther down
  volume(cube.mesh);
}

TEST(CutAlong, ABorderThatEndsOnAVertexGoesThere) {
  Cube cube;
  cube.mesh.point_cad[cube.rim] = {0, 9};
  const std::vector<int> regions = cut_along(cube.mesh, cube.region, {cube.border(10, 3.4)}, Monitor());
  EXPECT_EQ(*cube.between(regions, 10).begin(), 3.0);
}

}  // namespace
}  // namespace polycube
