#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cad/assembly.h"
#include "core/error.h"
#include "support/files.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using files::refusal;
using files::TestFile;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Assembly assembly(const std::string& brep) { return Assembly::from_brep(brep); }

/// A box of 4 x 4 x 2 on one of 10 x 10 x 3.
std::string box_on_box() { return shapes::compound(shapes::box(10, 10, 3), shapes::moved(shapes::box(4, 4, 2), 0, 3, 3, 3)); }

TEST(Assembly, OneSolidIsAsItWas) {
  const std::string box = shapes::box(1, 2, 3);
  const Assembly one = assembly(box);
  ASSERT_EQ(one.solids.size(), 1u);
  EXPECT_EQ(one.solids[0].to_brep(), CadModel::from_brep(box).to_brep());
  EXPECT_TRUE(one.interfaces.empty());
  EXPECT_EQ(one.name(1), "Solid1");
}

TEST(Assembly, NumbersAreThoseOfTheWhole) {
  const Assembly two = assembly(box_on_box());
  ASSERT_EQ(two.solids.size(), 2u);
  EXPECT_THAT(two.solids[0].faces(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(two.solids[1].faces(), ElementsAre(7, 8, 9, 10, 11, 12));
  EXPECT_EQ(two.faces().size(), 12u);
  EXPECT_EQ(two.edges().size(), 24u);
  EXPECT_NEAR(two.volume(), 332, 1e-9);
}

// As files of surfaces alone hold parts: in the order of the file, with a solid in the void of another.
TEST(Assembly, FacesSewToSeveralSolids) {
  const std::string small = shapes::taken_apart(shapes::box(1, 2, 3)), inner = shapes::taken_apart(shapes::moved(shapes::box(1, 1, 1), 0, 104, 4, 4));
  const std::string hollow = shapes::taken_apart(shapes::moved(shapes::hollow_box(10), 0, 100, 0, 0));
  const Assembly three = assembly(shapes::compound(small, shapes::compound(hollow, inner)));
  ASSERT_EQ(three.solids.size(), 3u);
  const double hollow_volume = CadModel::from_brep(shapes::hollow_box(10)).volume();
  EXPECT_NEAR(three.solids[0].volume(), 6, 1e-9);
  EXPECT_NEAR(three.solids[1].volume(), hollow_volume, 1e-6);
  EXPECT_NEAR(three.solids[2].volume(), 1, 1e-9);
  EXPECT_THAT(three.solids[0].faces(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(three.faces().size(), 24u);
  EXPECT_THAT(three.warnings, ElementsAre(HasSubstr("24 faces are sewn to 3 solids")));
  const TestFile iges("two.igs");
  shapes::write_iges(box_on_box(), iges.path());
  EXPECT_THAT(refusal([&] { CadModel::read(iges.path()); }), HasSubstr("solids"));
}

TEST(Assembly, FacesThatTouchInPartAreAnInterface) {
  const Assembly two = assembly(box_on_box());
  ASSERT_EQ(two.interfaces.size(), 1u);
  const Interface& i = two.interfaces[0];
  EXPECT_EQ(i.solids, (std::array{1, 2}));
  EXPECT_NEAR(i.area, 16, 1e-6);
  ASSERT_EQ(i.faces[0].size(), 1u);
  ASSERT_EQ(i.faces[1].size(), 1u);
  EXPECT_NEAR(two.solids[0].face(i.faces[0][0]).area, 100, 1e-9);
  EXPECT_NEAR(two.solids[1].face(i.faces[1][0]).area, 16, 1e-9);
}

TEST(Assembly, SolidsThatShareAFaceShareItsNumber) {
  const Assembly two = assembly(shapes::fused({shapes::box(2, 2, 1), shapes::moved(shapes::box(2, 2, 3), 0, 0, 0, 1)}));
  ASSERT_EQ(two.interfaces.size(), 1u);
  EXPECT_EQ(two.interfaces[0].faces[0], two.interfaces[0].faces[1]);
  EXPECT_EQ(two.faces().size(), 11u);
}

TEST(Assembly, AnInclusionTouchesAllRound) {
  const Assembly two = assembly(shapes::fused({shapes::box(4, 4, 4), shapes::moved(shapes::sphere(1), 0, 2, 2, 2)}));
  ASSERT_EQ(two.solids.size(), 2u);
  ASSERT_EQ(two.interfaces.size(), 1u);
  EXPECT_NEAR(two.interfaces[0].area, 4 * 3.14159265358979, 1e-6);
}

TEST(Assembly, SolidsApartOrThatMeetInAnEdgeHaveNoInterface) {
  const std::string box = shapes::box(1, 1, 1);
  const Assembly apart = assembly(shapes::compound(box, shapes::moved(box, 0, 5, 0, 0)));
  EXPECT_TRUE(apart.interfaces.empty());
  EXPECT_TRUE(apart.warnings.empty());
  const Assembly edge = assembly(shapes::compound(box, shapes::moved(box, 0, 1, 1, 0)));
  EXPECT_TRUE(edge.interfaces.empty());
  EXPECT_THAT(edge.warnings, ElementsAre(::testing::MatchesRegex("Solid1 and Solid2 meet in Edge[0-9]+ alone: .*")));
  const Assembly point = assembly(shapes::compound(box, shapes::moved(box, 0, 1, 1, 1)));
  EXPECT_THAT(point.warnings, ElementsAre(::testing::MatchesRegex("Solid1 and Solid2 meet in Vertex[0-9]+ alone: .*")));
  // Over the third box the two have the edge's nodes in common.
  EXPECT_TRUE(assembly(shapes::compound(shapes::compound(box, shapes::moved(box, 0, 1, 1, 0)), shapes::moved(box, 0, 1, 0, 0))).warnings.empty());
}

TEST(Assembly, TangentSolidsAreTold) {
  const std::string ball = shapes::moved(shapes::sphere(1), 0, 2, 2, 3);
  EXPECT_THAT(assembly(shapes::compound(shapes::box(4, 4, 2), ball)).warnings,
              ElementsAre("Solid1 and Solid2 touch in a line or a point alone: they have no nodes in common, and no load passes from one to the other"));
  EXPECT_THAT(assembly(shapes::compound(shapes::sphere(1), shapes::moved(shapes::sphere(1), 0, 2, 0, 0))).warnings,
              ElementsAre(HasSubstr("touch in a line or a point alone")));
  EXPECT_THAT(assembly(shapes::compound(shapes::box(4, 4, 2), shapes::moved(ball, 0, 0, 0, 1))).warnings, IsEmpty());
}

TEST(Assembly, GapsThatAreHardlyMeantAreTold) {
  const auto warnings = [](double gap) {
    return assembly(shapes::compound(shapes::box(4, 4, 2), shapes::moved(shapes::box(4, 4, 2), 0, 0, 0, 2 + gap))).warnings;
  };
  EXPECT_THAT(warnings(2e-4), ElementsAre("Solid1 and Solid2 do not touch: they are 0.0002 mm apart, and have no common nodes"));
  EXPECT_THAT(warnings(0), IsEmpty());
  EXPECT_THAT(warnings(0.01), IsEmpty());
  // They meet in an edge, which is no gap.
  EXPECT_THAT(assembly(shapes::compound(shapes::box(1, 1, 1), shapes::moved(shapes::box(1, 1, 1), 0, 1, 1, 0))).warnings, ElementsAre(HasSubstr(" meet in ")));
}

TEST(Assembly, OverlapsAreRefusedWithTheirVolume) {
  const auto refused = [](const std::string& a, const std::string& b) { return refusal([&] { assembly(shapes::compound(a, b)); }); };
  EXPECT_THAT(refused(shapes::box(2, 2, 2), shapes::moved(shapes::box(2, 2, 2), 0, 1, 0, 0)),
              HasSubstr("Solid1 and Solid2 overlap: they have 4 mm^3 in common"));
  // One inside the other, which touches none of its faces.
  EXPECT_THAT(refused(shapes::box(4, 4, 4), shapes::moved(shapes::box(1, 1, 1), 0, 1, 1, 1)), HasSubstr("1 mm^3 in common"));
}

TEST(Assembly, TheSolidAtFaultIsNamed) {
  EXPECT_THAT(refusal([] { assembly(shapes::compound(shapes::box(1, 1, 1), shapes::moved(shapes::open_solid(1), 0, 5, 0, 0))); }),
              HasSubstr("Solid2: the shape is open at Edge"));
}

TEST(Assembly, LooseEntitiesAreToldOfTheWhole) {
  const Assembly two = assembly(shapes::compound(shapes::compound(shapes::box(1, 1, 1), shapes::moved(shapes::loose_face(1), 0, 0, 0, 9)),
                                                 shapes::moved(shapes::box(1, 1, 1), 0, 5, 0, 0)));
  EXPECT_THAT(two.warnings, ElementsAre("left out beside the solid: 1 loose face"));
  EXPECT_TRUE(two.solids[0].warnings().empty());
}

TEST(Assembly, StepHasTheNamesOfItsProducts) {
  const TestFile file("two.step");
  shapes::write_step_products({{"Plate", shapes::box(10, 10, 3)}, {"Post", shapes::moved(shapes::box(4, 4, 2), 0, 3, 3, 3)}}, file.path());
  const Assembly two = Assembly::read(file.path());
  // The writer puts a number behind each.
  EXPECT_THAT(two.labels, ElementsAre(StartsWith("Plate"), StartsWith("Post")));
  EXPECT_THAT(two.name(2), StartsWith("Solid2 \"Post"));
  EXPECT_EQ(two.interfaces.size(), 1u);
}

}  // namespace
}  // namespace polycube
