#include "pipeline/vertex_room.h"

#include <gtest/gtest.h>

#include "label/features.h"
#include "pipeline/label_part.h"
#include "support/shapes.h"

namespace polycube {
namespace {

std::vector<DistanceConstraint> room(const std::string& brep, bool ignore_all = false) {
  const CadModel model = CadModel::from_brep(brep);
  const LabelledPart part = label_part(model, MeshOptions(), Monitor());
  const std::vector<char> ignored(static_cast<std::size_t>(model.edge_count()) + 1, ignore_all);
  return room_for_vertices(model, part.tets, part.map, extract_blocks(part.tets, part.map, Monitor()), edge_chains(model, part.tets), ignored);
}

// The bore's seam ends in the middle of both ends of the rib, between two vertices that are corners.
TEST(VertexRoom, AVertexBetweenTwoOthersNeedsTwoCells) {
  const auto constraints = room(shapes::ribbed_cup(20));
  ASSERT_FALSE(constraints.empty());
  for (const DistanceConstraint& c : constraints) EXPECT_EQ(c.at_least, 2);
  EXPECT_TRUE(room(shapes::ribbed_cup(20), true).empty());
}

// The seam's vertices on a cylinder's rims may take a corner of the polycube, which is no vertex there.
TEST(VertexRoom, AsksNothingWhereCornersAreFree) {
  EXPECT_TRUE(room(shapes::box(10, 20, 30)).empty());
  EXPECT_TRUE(room(shapes::cylinder(5, 12)).empty());
  EXPECT_TRUE(room(shapes::plate_with_hole(30, 20, 6, 4)).empty());
}

}  // namespace
}  // namespace polycube
