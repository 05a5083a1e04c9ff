#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cad/cad.h"
#include "support/shapes.h"

namespace polycube {
namespace {

TEST(SelfContacts, NamesTheFacesThatCross) {
  const CadModel model = CadModel::from_brep(shapes::crossed_box(10));
  std::vector<int> faces;
  for (const CadRef& c : model.self_contacts()) {
    if (c.dim == 2) faces.push_back(c.id);
  }
  // The side of the cube at x = 10, and the four sides of the void that pass through it.
  ASSERT_EQ(faces.size(), 5u);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [&](int f) { return std::abs(model.face(f).area - 100) < 1e-6; }), 1);
  EXPECT_EQ(std::count_if(faces.begin(), faces.end(), [&](int f) { return std::abs(model.face(f).area - 20) < 1e-6; }), 4);
}

TEST(SelfContacts, FindsNoneInSoundSolids) {
  for (const std::string& brep : {shapes::box(1, 2, 3), shapes::tube(10, 4, 30), shapes::cone(5, 0, 8), shapes::torus(10, 3), shapes::filleted_box(10, 2)}) {
    EXPECT_TRUE(CadModel::from_brep(brep).self_contacts().empty());
  }
}

}  // namespace
}  // namespace polycube
