#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "cad/conformal.h"
#include "core/error.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

ConformalModel joined(const std::vector<std::string>& breps) {
  std::string compound = breps[0];
  for (std::size_t i = 1; i < breps.size(); ++i) compound = shapes::compound(compound, breps[i]);
  const Assembly assembly = Assembly::from_brep(compound);
  std::vector<int> all;
  for (int s = 1; s <= static_cast<int>(assembly.solids.size()); ++s) all.push_back(s);
  return conform(assembly, all, Monitor());
}

TEST(Conform, FacesAreCutWhereSolidsTouch) {
  const ConformalModel two = joined({shapes::box(10, 10, 3), shapes::moved(shapes::box(4, 4, 2), 0, 3, 3, 3)});
  ASSERT_THAT(two.interfaces, SizeIs(1));
  const auto& [face, solids] = two.interfaces[0];
  EXPECT_EQ(solids, (std::array{0, 1}));
  EXPECT_NEAR(two.whole.face(face).area, 16, 1e-9);
  EXPECT_NEAR(two.outer.volume(), 332, 1e-9);
  EXPECT_EQ(two.outer.euler_characteristic(), 2);
  EXPECT_THAT(two.outer.faces(), SizeIs(11));
  EXPECT_THAT(two.solids[0].faces(), SizeIs(7));
  EXPECT_THAT(two.solids[1].faces(), SizeIs(6));
  // The two parts of the lower box's top are what was one face; the interface is a face of the upper box too.
  const int top = two.origins[0].faces[static_cast<std::size_t>(face)];
  EXPECT_EQ(std::count(two.origins[0].faces.begin(), two.origins[0].faces.end(), top), 2);
  EXPECT_GT(two.origins[1].faces[static_cast<std::size_t>(face)], 6);
}

TEST(Conform, PlacesAreThoseOfTheSolids) {
  const ConformalModel two = joined({shapes::plate_with_hole(20, 20, 4, 3), shapes::moved(shapes::cylinder(3, 6), 0, 10, 10, 0)});
  EXPECT_FALSE(two.interfaces.empty());
  for (const CadModel& solid : two.solids) {
    for (const int f : solid.faces()) {
      const Vec3 somewhere = solid.face_point(f, Vec2(0.3, 0.2)) + Vec3(0.1, -0.2, 0.15);
      EXPECT_LT((solid.project_to_face(f, somewhere).point - two.whole.project_to_face(f, somewhere).point).norm(), 1e-9) << f;
    }
    for (const int v : solid.vertices()) EXPECT_EQ(solid.vertex(v), two.whole.vertex(v));
  }
}

TEST(Conform, AnInclusionIsNoPartOfTheOuterBoundary) {
  const ConformalModel two = joined({shapes::fused({shapes::box(4, 4, 4), shapes::moved(shapes::sphere(1), 0, 2, 2, 2)})});
  EXPECT_THAT(two.outer.faces(), SizeIs(6));
  EXPECT_NEAR(two.outer.volume(), 64, 1e-9);
  EXPECT_THAT(two.interfaces, SizeIs(1));
}

TEST(Conform, WhatMeetsInAnEdgeTooIsRefused) {
  try {
    joined({shapes::box(2, 2, 2), shapes::moved(shapes::box(2, 2, 2), 0, 2, 0, 0), shapes::moved(shapes::box(2, 2, 2), 0, 4, 2, 0),
            shapes::moved(shapes::box(6, 4, 2), 0, 0, 0, 2)});
    FAIL() << "accepted";
  } catch (const StageFailed& error) {
    EXPECT_EQ(error.stage(), "interfaces");
    EXPECT_THAT(error.what(), HasSubstr("more than two faces meet"));
  }
}

}  // namespace
}  // namespace polycube
