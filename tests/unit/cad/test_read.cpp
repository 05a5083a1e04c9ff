#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>

#include "cad/cad.h"
#include "core/error.h"
#include "support/files.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using files::refusal;
using files::TestFile;
using std::numbers::pi;
using ::testing::HasSubstr;

CadModel model(const std::string& brep) { return CadModel::from_brep(brep); }

std::string refusal_of_brep(const std::string& brep) {
  return refusal([&] { model(brep); });
}

TEST(Read, CountsAndMeasuresPrimitives) {
  const CadModel box = model(shapes::box(1, 2, 3));
  EXPECT_EQ(box.face_count(), 6);
  EXPECT_EQ(box.edge_count(), 12);
  EXPECT_EQ(box.vertex_count(), 8);
  EXPECT_NEAR(box.volume(), 6, 1e-12);
  EXPECT_NEAR(box.diagonal(), std::sqrt(14.0), 1e-12);
  const CadModel sphere = model(shapes::sphere(2));
  EXPECT_EQ(sphere.face_count(), 1);
  EXPECT_NEAR(sphere.volume(), 32 * pi / 3, 1e-9);
  EXPECT_NEAR(sphere.face(1).area, 16 * pi, 1e-9);
  EXPECT_NEAR(sphere.diagonal(), 4 * std::sqrt(3.0), 1e-6);
}

TEST(Read, EulerCharacteristic) {
  EXPECT_EQ(model(shapes::box(1, 2, 3)).euler_characteristic(), 2);
  EXPECT_EQ(model(shapes::cylinder(1, 2)).euler_characteristic(), 2);
  EXPECT_EQ(model(shapes::cone(1, 0, 2)).euler_characteristic(), 2);
  EXPECT_EQ(model(shapes::sphere(1)).euler_characteristic(), 2);
  EXPECT_EQ(model(shapes::torus(3, 1)).euler_characteristic(), 0);
  EXPECT_EQ(model(shapes::plate_with_hole(10, 10, 2, 2)).euler_characteristic(), 0);
  EXPECT_EQ(model(shapes::hollow_box(10)).euler_characteristic(), 4);
  const CadModel pocket = model(shapes::pocket_beside_seam());  // two wires of a face touch: the vertex cuts the seam in two
  EXPECT_EQ(std::count_if(pocket.edges().begin(), pocket.edges().end(), [&](int e) { return pocket.edge(e).seam; }), 2);
  EXPECT_EQ(pocket.euler_characteristic(), 2);
}

TEST(Read, DescribesSurfaces) {
  const CadModel plate = model(shapes::plate_with_hole(10, 8, 2, 1.5));
  int cylinders = 0;
  for (int f = 1; f <= plate.face_count(); ++f) {
    const CadFace& face = plate.face(f);
    if (face.kind == SurfaceKind::kCylinder) {
      ++cylinders;
      EXPECT_NEAR(face.radius, 1.5, 1e-12);
      EXPECT_NEAR(std::abs(face.axis.z()), 1, 1e-12);
      EXPECT_NEAR(face.centre.x(), 5, 1e-12);
      EXPECT_NEAR(face.centre.y(), 4, 1e-12);
      EXPECT_NEAR(face.area, 2 * pi * 1.5 * 2, 1e-9);
    } else {
      EXPECT_EQ(face.kind, SurfaceKind::kPlane);
      // Outward: away from the plate's middle.
      EXPECT_GT(face.axis.dot(face.centre - Vec3(5, 4, 1)), 0.5);
    }
  }
  EXPECT_EQ(cylinders, 1);
}

TEST(Read, RecognisesRevolvedSurfaces) {
  const CadModel shaft = model(shapes::turned(3, 10, 1));
  std::map<SurfaceKind, int> kinds;
  for (int f = 1; f <= shaft.face_count(); ++f) {
    const CadFace& face = shaft.face(f);
    ++kinds[face.kind];
    if (face.kind == SurfaceKind::kCylinder) {
      EXPECT_NEAR(face.radius, 3, 1e-9);
    }
    if (face.kind == SurfaceKind::kTorus) {
      EXPECT_NEAR(face.radius, 1, 1e-9);
    }
    if (face.kind == SurfaceKind::kPlane) {
      EXPECT_GT(face.axis.dot(face.centre - Vec3(0, 0, 5)), 4.9);
    }
  }
  EXPECT_EQ(kinds[SurfaceKind::kCylinder], 2);
  EXPECT_EQ(kinds[SurfaceKind::kTorus], 1);
  EXPECT_EQ(kinds[SurfaceKind::kPlane], 2);
}

TEST(Read, DihedralAngles) {
  const CadModel box = model(shapes::box(1, 2, 3));
  for (int e = 1; e <= box.edge_count(); ++e) {
    EXPECT_NEAR(box.edge(e).min_angle, pi / 2, 1e-12);
    EXPECT_NEAR(box.edge(e).max_angle, pi / 2, 1e-12);
  }
  const CadModel bracket = model(shapes::l_bracket(10, 2, 5));
  int concave = 0;
  for (int e = 1; e <= bracket.edge_count(); ++e)
    if (bracket.edge(e).min_angle > pi) {
      ++concave;
      EXPECT_NEAR(bracket.edge(e).min_angle, 3 * pi / 2, 1e-12);
      EXPECT_NEAR(bracket.edge(e).length, 5, 1e-12);
    }
  EXPECT_EQ(concave, 1);
  const CadModel rounded = model(shapes::filleted_box(10, 2));
  for (int e = 1; e <= rounded.edge_count(); ++e)
    if (!rounded.edge(e).degenerate) {
      EXPECT_NEAR(rounded.edge(e).min_angle, pi, 1e-6);
      EXPECT_NEAR(rounded.edge(e).max_angle, pi, 1e-6);
    }
  const CadModel chamfered = model(shapes::chamfered_box(10, 2));
  int blunt = 0;
  for (int e = 1; e <= chamfered.edge_count(); ++e) blunt += std::abs(chamfered.edge(e).min_angle - 3 * pi / 4) < 1e-9;
  EXPECT_EQ(blunt, 2);
  // Inside a void every edge is concave.
  const CadModel hollow = model(shapes::hollow_box(10));
  int reflex = 0;
  for (int e = 1; e <= hollow.edge_count(); ++e) reflex += std::abs(hollow.edge(e).min_angle - 3 * pi / 2) < 1e-9;
  EXPECT_EQ(reflex, 12);
}

TEST(Read, SeamsAndPoles) {
  const CadModel cone = model(shapes::cone(2, 0, 3));
  int seams = 0, degenerate = 0, tips = 0;
  for (int e = 1; e <= cone.edge_count(); ++e) {
    seams += cone.edge(e).seam;
    degenerate += cone.edge(e).degenerate;
    tips += cone.edge(e).tip;
    if (cone.edge(e).seam) {
      EXPECT_NEAR(cone.edge(e).min_angle, pi, 1e-9);
    }
  }
  EXPECT_EQ(seams, 1);
  EXPECT_EQ(degenerate, 1);
  EXPECT_EQ(tips, 1);
  const CadModel ball = model(shapes::sphere(3)), blunt = model(shapes::cone(2, 0, 0.7));
  for (int e = 1; e <= ball.edge_count(); ++e) EXPECT_FALSE(ball.edge(e).tip);
  for (int e = 1; e <= blunt.edge_count(); ++e) EXPECT_EQ(blunt.edge(e).tip, blunt.edge(e).degenerate);
}

TEST(Read, TinyEdgesArePoints) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 5e-5));
  ASSERT_EQ(model.vertex_count(), 10);
  int tiny = 0;
  std::map<int, int> ends;
  for (int e = 1; e <= model.edge_count(); ++e) {
    tiny += model.edge(e).tiny;
    EXPECT_EQ(model.edge(e).tiny, model.edge(e).length < 1e-4);
    EXPECT_EQ(model.edge(e).tiny, model.edge(e).vertices[0] == model.edge(e).vertices[1]);
    for (int v : model.edge(e).vertices) ++ends[v];
  }
  EXPECT_EQ(tiny, 2);
  EXPECT_EQ(ends.size(), 8u);
  EXPECT_EQ(model.euler_characteristic(), 2);
}

TEST(Read, BrepKeepsTheNumbering) {
  for (const std::string& brep : {shapes::plate_with_hole(10, 8, 2, 1.5), shapes::filleted_box(10, 2), shapes::hollow_box(10), shapes::loft(4, 5)}) {
    const CadModel first = model(brep), second = model(first.to_brep());
    ASSERT_EQ(first.face_count(), second.face_count());
    ASSERT_EQ(first.edge_count(), second.edge_count());
    for (int f = 1; f <= first.face_count(); ++f) {
      EXPECT_NEAR(first.face(f).area, second.face(f).area, 1e-9);
      EXPECT_EQ(first.face(f).edges, second.face(f).edges);
    }
    for (int v = 1; v <= first.vertex_count(); ++v) EXPECT_LT((first.vertex(v) - second.vertex(v)).norm(), 1e-12);
  }
}

TEST(Read, CompoundOfOneSolidIsThatSolid) {
  const std::string box = shapes::box(1, 1, 1);
  EXPECT_THAT(refusal_of_brep(shapes::compound(box, box)), HasSubstr("solids"));
  EXPECT_THAT(refusal_of_brep(shapes::compound(box, shapes::moved(box, 0, 5, 0, 0))), HasSubstr("2 solids"));
}

TEST(Read, RefusesWhatIsNoSolid) {
  EXPECT_THAT(refusal_of_brep(shapes::open_box(1)), HasSubstr("not a solid"));
  EXPECT_THAT(refusal_of_brep(shapes::loose_face(1)), HasSubstr("not a solid"));
  EXPECT_THAT(refusal_of_brep(shapes::open_solid(1)), HasSubstr("open at Edge"));
  EXPECT_NE(refusal_of_brep(shapes::flat_solid(1)), "accepted");
  EXPECT_NE(refusal_of_brep(""), "accepted");
  EXPECT_NE(refusal_of_brep("DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nLocations 0\n"), "accepted");
  EXPECT_NE(refusal_of_brep("not a shape at all\n"), "accepted");
  EXPECT_THAT(refusal_of_brep(shapes::scaled(shapes::box(1, 1, 1), 1e-6)), HasSubstr("size"));
  EXPECT_NE(refusal_of_brep(shapes::scaled(shapes::box(1, 1, 1), 1e12)), "accepted");
}

TEST(Read, RefusesDamagedText) {
  // Whatever is done to a file ends in a model or in a refusal, never in a crash.
  const std::string whole = shapes::plate_with_hole(10, 8, 2, 1.5);
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 23) EXPECT_NE(refusal_of_brep(whole.substr(0, length)), "accepted");
  std::string nan = shapes::box(1, 2, 3);
  for (std::size_t at = nan.find("\n1 0 0 "); at != std::string::npos; at = nan.find("\n1 0 0 ")) nan.replace(at, 7, "\nnan 0 0 ");
  EXPECT_NE(refusal_of_brep(nan), "accepted");
}

TEST(Read, Files) {
  EXPECT_THAT(refusal([] { CadModel::read("/nowhere/part.step"); }), HasSubstr("no such file"));
  const TestFile empty("empty.step", ""), text("text.step", "Dear Sir,\nthis is a letter.\n"), brep("box.brep", shapes::box(1, 2, 3)),
      odd("box.stl", shapes::box(1, 2, 3)), header("header.stp", "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n"),
      bad("text.brep", "Dear Sir,\n");
  EXPECT_THAT(refusal([&] { CadModel::read(empty.path()); }), HasSubstr("empty"));
  for (const TestFile* file : {&text, &odd, &header, &bad}) {
    const std::string line = refusal([&] { CadModel::read(file->path()); });
    EXPECT_NE(line, "accepted");
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
  EXPECT_EQ(CadModel::read(brep.path()).face_count(), 6);
}

}  // namespace
}  // namespace polycube
