// Layers, divisions and local sizes from the options to the mesh.
#include "pipeline/demands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using ::testing::HasSubstr;

struct Sides {
  int low = 0, high = 0;  ///< CAD faces
};

/// The plane faces square to an axis at both ends of the box.
Sides faces_along(const CadModel& model, int axis) {
  Sides sides;
  for (int f = 1; f <= model.face_count(); ++f) {
    const CadFace& face = model.face(f);
    if (face.kind != SurfaceKind::kPlane || std::abs(face.axis[axis]) < 0.9) continue;
    (face.axis[axis] > 0 ? sides.high : sides.low) = f;
  }
  return sides;
}

int straight_edge_along(const CadModel& model, int axis) {
  for (int e = 1; e <= model.edge_count(); ++e) {
    const auto [from, to] = model.edge(e).vertices;
    if (from != to && !model.edge(e).seam && std::abs((model.vertex(to) - model.vertex(from)).normalized()[axis]) > 0.999) return e;
  }
  return 0;
}

int circle(const CadModel& model) {
  for (int e = 1; e <= model.edge_count(); ++e) {
    if (model.edge(e).closed) return e;
  }
  return 0;
}

Division between(const Sides& sides, int at_least, int at_most) {
  return {0, {std::min(sides.low, sides.high), std::max(sides.low, sides.high)}, at_least, at_most};
}

std::vector<std::string> unmet(const MeshResult& result, const Division& division) { return unmet_divisions(result.mesh, result.association, {division}); }

std::string complaint(const CadModel& model, const MeshOptions& options) {
  try {
    mesh(model, options, Monitor());
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

class Demands : public ::testing::Test {
 protected:
  CadModel plate_ = CadModel::from_brep(shapes::plate_with_hole(40, 30, 3, 6));
  MeshOptions options_ = [] {
    MeshOptions o;
    o.size = 4;
    return o;
  }();
};

TEST_F(Demands, ThreeLayersThroughTheWall) {
  const Sides wall = faces_along(plate_, 2);
  const MeshResult thin = mesh(plate_, options_, Monitor());
  EXPECT_FALSE(unmet(thin, between(wall, 3, Division::kNoMaximum)).empty());
  options_.min_layers = 3;
  const MeshResult result = mesh(plate_, options_, Monitor());
  EXPECT_TRUE(unmet(result, between(wall, 3, 3)).empty());
  EXPECT_TRUE(result.report.warnings.empty());
}

TEST_F(Demands, ExactAndMostBetweenTwoFaces) {
  const Sides wall = faces_along(plate_, 2), length = faces_along(plate_, 0);
  options_.divisions = {between(wall, 5, 5), between(length, 1, 6)};
  const MeshResult result = mesh(plate_, options_, Monitor());
  EXPECT_TRUE(result.report.warnings.empty());
  EXPECT_TRUE(unmet(result, between(wall, 5, 5)).empty());
  EXPECT_FALSE(unmet(result, between(wall, 4, 4)).empty());
  EXPECT_TRUE(unmet(result, between(length, 1, 6)).empty());
}

TEST_F(Demands, DivisionsOfEdges) {
  const Division edge{straight_edge_along(plate_, 0), {}, 13, 13}, round{circle(plate_), {}, 16, 16};
  options_.divisions = {edge, round};
  const MeshResult result = mesh(plate_, options_, Monitor());
  EXPECT_TRUE(result.report.warnings.empty());
  EXPECT_TRUE(unmet(result, edge).empty());
  EXPECT_TRUE(unmet(result, round).empty());
  EXPECT_FALSE(unmet(result, {edge.edge, {}, 1, 12}).empty());
}

TEST_F(Demands, SizePerDirectionAndFace) {
  const Sides length = faces_along(plate_, 0), width = faces_along(plate_, 1);
  options_.sizes = {{0, 0, 2.0}};
  const MeshResult along = mesh(plate_, options_, Monitor());
  EXPECT_TRUE(unmet(along, between(length, 19, 21)).empty());
  EXPECT_TRUE(unmet(along, between(width, 6, 9)).empty());
  options_.sizes = {{faces_along(plate_, 0).high, 0, 1.0}};
  const MeshResult face = mesh(plate_, options_, Monitor());
  // Finer at one end only.
  EXPECT_TRUE(unmet(face, between(length, 14, 34)).empty());
}

TEST_F(Demands, TurnedAndScaledPartsKeepThem) {
  const CadModel turned = CadModel::from_brep(shapes::moved(shapes::scaled(shapes::plate_with_hole(40, 30, 3, 6), 2), 40, 5, 6, 7));
  options_.size = 8;
  options_.divisions = {between(faces_along(plate_, 2), 2, 2), {straight_edge_along(plate_, 0), {}, 9, 9}};
  const MeshResult result = mesh(turned, options_, Monitor());
  EXPECT_TRUE(result.report.warnings.empty());
  EXPECT_TRUE(unmet_divisions(result.mesh, result.association, options_.divisions).empty());
}

// The tube's wall is padded under its outer face: what is asked for is what comes out nevertheless.
TEST(PaddedDemands, AreExactToo) {
  const CadModel tube = CadModel::from_brep(shapes::tube(10, 7, 20));
  std::vector<int> round;
  for (int f = 1; f <= tube.face_count(); ++f) {
    if (tube.face(f).kind == SurfaceKind::kCylinder) round.push_back(f);
  }
  ASSERT_EQ(round.size(), 2u);
  MeshOptions options;
  options.size = 3;
  options.divisions = {{0, {round[0], round[1]}, 4, 4}};
  const MeshResult result = mesh(tube, options, Monitor());
  EXPECT_TRUE(result.report.warnings.empty());
  EXPECT_TRUE(unmet(result, options.divisions[0]).empty());
  EXPECT_GT(result.report.padded_hexes, 0);
}

TEST_F(Demands, ContradictionsAreNamed) {
  options_.min_layers = 3;
  options_.divisions = {between(faces_along(plate_, 2), 1, 2)};
  const std::string layers = complaint(plate_, options_);
  EXPECT_THAT(layers, HasSubstr("at least 3 elements through every wall"));
  EXPECT_THAT(layers, HasSubstr(text_of(options_.divisions[0])));
  options_.min_layers = 1;
  const Division edge{straight_edge_along(plate_, 0), {}, 4, 4}, wall = between(faces_along(plate_, 0), 5, Division::kNoMaximum);
  options_.divisions = {edge, between(faces_along(plate_, 1), 7, 7), wall};
  const std::string both = complaint(plate_, options_);
  EXPECT_THAT(both, HasSubstr(text_of(edge)));
  EXPECT_THAT(both, HasSubstr(text_of(wall)));
  EXPECT_EQ(both.find(text_of(options_.divisions[1])), std::string::npos);
}

TEST_F(Demands, UnknownAndUnsuitedEntitiesAreNamed) {
  options_.divisions = {{99, {}, 2, 2}};
  EXPECT_THAT(complaint(plate_, options_), HasSubstr("Edge99"));
  options_.divisions = {{0, {1, 77}, 2, 2}};
  EXPECT_THAT(complaint(plate_, options_), HasSubstr("Face77"));
  for (int e = 1; e <= plate_.edge_count(); ++e) {
    if (!plate_.edge(e).seam) continue;
    options_.divisions = {{e, {}, 2, 2}};
    EXPECT_THAT(complaint(plate_, options_), HasSubstr("seam"));
  }
  options_.divisions = {{0, {2, 2}, 2, 2}};
  EXPECT_THAT(complaint(plate_, options_), HasSubstr("same"));
  const Sides wall = faces_along(plate_, 2), length = faces_along(plate_, 0);
  options_.divisions = {{0, {std::min(wall.low, length.low), std::max(wall.low, length.low)}, 2, 2}};
  try {
    mesh(plate_, options_, Monitor());
    FAIL() << "faces that are not opposite were accepted";
  } catch (const StageFailed& e) {
    EXPECT_THAT(e.what(), HasSubstr("nowhere opposite"));
    EXPECT_EQ(e.entities().size(), 2u);
  }
}

}  // namespace
}  // namespace polycube
