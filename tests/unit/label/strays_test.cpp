#include "label/strays.h"

#include <gtest/gtest.h>

#include <functional>

#include "support/tet_grid.h"

namespace polycube {
namespace {

/// A cube of 8 x 8 x 8 cells, labelled as its sides are; of the upper side the triangles whose middle `inside` says yes to are +X.
std::pair<TetMesh, Labelling> cube(const std::function<bool(double, double)>& inside) {
  TetMesh mesh = tet_grid(8, 8, 8);
  Labelling labelling;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Vec3 middle = Vec3::Zero();
    for (int n : mesh.triangles[t]) middle += mesh.points[n] / 3;
    const bool other = mesh.triangle_face[t] == 5 && inside(middle[0], middle[1]);
    labelling.label.push_back(other ? 0 : mesh.triangle_face[t] - 1);
  }
  return {std::move(mesh), std::move(labelling)};
}

TEST(Strays, AreAbsorbed) {
  auto [mesh, labelling] = cube([](double x, double y) { return x > 3 && x < 4 && y > 3 && y < 4; });
  const std::vector<int> whole = cube([](double, double) { return false; }).second.label;
  ASSERT_NE(labelling.label, whole);
  EXPECT_EQ(absorb_strays(mesh, labelling, Monitor()), 1);
  EXPECT_EQ(labelling.label, whole);
  EXPECT_EQ(absorb_strays(mesh, labelling, Monitor()), 0);
}

TEST(Strays, ThatTouchEachOtherToo) {
  auto [mesh, labelling] = cube([](double x, double y) { return x > 3 && x < 4 && y > 3 && y < 4; });
  for (int& label : labelling.label) {
    if (label != 0) continue;
    label = 3;  // the first triangle of the +X side or of the sliver
    break;
  }
  EXPECT_GE(absorb_strays(mesh, labelling, Monitor()), 2);
  EXPECT_EQ(labelling.label, cube([](double, double) { return false; }).second.label);
}

TEST(Strays, ChartsOfSomeSizeStayAndSoDoTonguesOfTheirNeighbours) {
  auto [mesh, labelling] = cube([](double x, double y) { return x > 2 && x < 6 && y > 2 && y < 6; });
  std::vector<int> before = labelling.label;
  EXPECT_EQ(absorb_strays(mesh, labelling, Monitor()), 0);
  EXPECT_EQ(labelling.label, before);
  std::tie(mesh, labelling) = cube([](double x, double y) { return x > 7 && y > 3 && y < 4; });
  before = labelling.label;
  EXPECT_EQ(absorb_strays(mesh, labelling, Monitor()), 0);
  EXPECT_EQ(labelling.label, before);
}

}  // namespace
}  // namespace polycube
