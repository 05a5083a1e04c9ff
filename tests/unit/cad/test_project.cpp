#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Eigen/Geometry>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <random>
#include <sstream>
#include <thread>

#include "cad/cad.h"
#include "cad/shape.h"
#include "support/shapes.h"

namespace polycube {
namespace {

struct Case {
  const char* name;
  std::string brep;
};

std::vector<Case> cases() {
  std::vector<Case> all{{"box", shapes::box(1, 2, 3)},
                        {"cylinder", shapes::cylinder(1, 2)},
                        {"cone", shapes::cone(2, 0, 3)},
                        {"frustum", shapes::cone(2, 1, 3)},
                        {"sphere", shapes::sphere(1.5)},
                        {"torus", shapes::torus(3, 1)},
                        {"plate", shapes::plate_with_hole(10, 8, 2, 1.5)},
                        {"bracket", shapes::l_bracket(10, 2, 5)},
                        {"filleted", shapes::filleted_box(10, 2)},
                        {"half", shapes::half_cylinder(2, 3)},
                        {"turned", shapes::turned(3, 10, 1)},
                        {"loft", shapes::loft(4, 5)}};
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) all.push_back({all[i].name, shapes::moved(all[i].brep, 37, 3, -2, 5)});
  return all;
}

TopoDS_Shape occt(const std::string& brep) {
  std::istringstream stream(brep);
  TopoDS_Shape shape;
  BRepTools::Read(shape, stream, BRep_Builder());
  return shape;
}

std::vector<Vec3> points_around(const CadModel& model, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-0.2, 1.2);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i)
    points.push_back(model.box_min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(model.box_max() - model.box_min()));
  return points;
}

gp_Pnt to_point(const Vec3& p) { return {p[0], p[1], p[2]}; }

double occt_distance(const TopoDS_Shape& shape, const Vec3& p) {
  return BRepExtrema_DistShapeShape(BRepBuilderAPI_MakeVertex(to_point(p)).Vertex(), shape).Value();
}

bool near_an_edge(const CadModel& model, const Vec3& p) {
  for (int e = 1; e <= model.edge_count(); ++e)
    if (!model.edge(e).seam && model.project_to_edge(e, p).distance < 2e-3) return true;
  return false;
}

// Every question that the grid answers it answers as the border does, piece by piece.
TEST(BorderGrid, AgreesWithTheBorder) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.05, 1.05);
  int answered = 0, asked = 0;
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    for (const int f : model.faces()) {
      const FaceGeometry& face = model.shape().face(f);
      for (int i = 0; i < 400; ++i) {
        const Vec2 uv = face.domain.min() + Vec2(unit(random), unit(random)).cwiseProduct(face.domain.sizes());
        const std::optional<bool> known = face.border_grid.inside(uv);
        ++asked;
        if (!known) continue;
        ++answered;
        EXPECT_EQ(*known, inside_by_border(model.shape(), face, uv)) << c.name << " face " << f << " at " << uv.transpose();
      }
    }
  }
  EXPECT_GT(answered, asked / 8);
}

TEST(Project, FacesAgreeWithOcctExtrema) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    const TopoDS_Shape shape = occt(c.brep);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    ASSERT_EQ(faces.Extent(), model.face_count());
    for (const Vec3& p : points_around(model, 30))
      for (int f = 1; f <= model.face_count(); ++f) {
        const FacePoint mine = model.project_to_face(f, p);
        EXPECT_NEAR(mine.distance, (mine.point - p).norm(), 1e-12);
        EXPECT_LT((model.face_point(f, mine.uv) - mine.point).norm(), 1e-6) << c.name << f;
        // OCCT's search may miss the nearest point, ours may not be farther than it.
        EXPECT_LT(mine.distance, occt_distance(faces(f), p) + 1e-7) << c.name << " Face" << f << " " << p.transpose();
        EXPECT_LT(occt_distance(faces(f), mine.point), 1e-6) << c.name << " Face" << f << " " << p.transpose();
      }
  }
}

TEST(Project, EdgesAgreeWithOcctExtrema) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    const TopoDS_Shape shape = occt(c.brep);
    TopTools_IndexedMapOfShape edges;
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    for (const Vec3& p : points_around(model, 20))
      for (int e = 1; e <= model.edge_count(); ++e) {
        if (model.edge(e).degenerate) continue;
        const EdgePoint mine = model.project_to_edge(e, p);
        EXPECT_LT((model.edge_point(e, mine.t) - mine.point).norm(), 1e-12);
        EXPECT_NEAR(mine.distance, occt_distance(edges(e), p), 1e-7) << c.name << " Edge" << e << " " << p.transpose();
      }
  }
}

TEST(Project, PointsOfTheFaceStay) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    for (const Vec3& p : points_around(model, 20))
      for (int f = 1; f <= model.face_count(); ++f) {
        const FacePoint first = model.project_to_face(f, p);
        EXPECT_LT(model.project_to_face(f, first.point).distance, 1e-9) << c.name << f;
        const FacePoint seeded = model.project_to_face(f, first.point, &first.uv);
        EXPECT_LT(seeded.distance, 1e-9) << c.name << f;
      }
  }
}

TEST(Project, EdgesLieOnTheirFaces) {
  // Seams above all: their points are inner points of the face whichever way the parameters are rounded.
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    for (int e = 1; e <= model.edge_count(); ++e)
      for (const int f : model.edge(e).faces)
        for (const Vec3& p : model.edge_samples(e, 33)) EXPECT_LT(model.project_to_face(f, p).distance, 1e-6) << c.name << " Edge" << e << " Face" << f;
  }
}

TEST(Project, SeedsFindTheSamePoint) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    for (const Vec3& p : points_around(model, 20)) {
      for (int f = 1; f <= model.face_count(); ++f) {
        const FacePoint foot = model.project_to_face(f, p);
        const Vec3 above = foot.point + 0.02 * model.diagonal() * model.face_normal(f, foot.uv);
        const FacePoint seeded = model.project_to_face(f, above, &foot.uv), plain = model.project_to_face(f, above);
        EXPECT_NEAR(seeded.distance, plain.distance, 1e-8) << c.name << f;
      }
      for (int e = 1; e <= model.edge_count(); ++e) {
        const EdgePoint foot = model.project_to_edge(e, p);
        EXPECT_LT(model.project_to_edge(e, foot.point, &foot.t).distance, 1e-9) << c.name << e;
      }
    }
  }
}

TEST(Project, NormalsPointOutward) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    const TopoDS_Shape shape = occt(c.brep);
    int tested = 0;
    for (int f = 1; f <= model.face_count(); ++f)
      for (const Vec3& p : points_around(model, 8)) {
        const FacePoint foot = model.project_to_face(f, p);
        const Vec3 normal = model.face_normal(f, foot.uv);
        EXPECT_NEAR(normal.norm(), 1, 1e-9);
        const bool on_border = foot.distance < 1e-2 || std::abs(normal.dot(p - foot.point)) < 0.999999 * foot.distance;
        if (on_border || near_an_edge(model, foot.point)) continue;
        ++tested;
        const Vec3 out = foot.point + 1e-3 * normal, in = foot.point - 1e-3 * normal;
        EXPECT_EQ(BRepClass3d_SolidClassifier(shape, to_point(out), 1e-7).State(), TopAbs_OUT) << c.name << f;
        EXPECT_EQ(BRepClass3d_SolidClassifier(shape, to_point(in), 1e-7).State(), TopAbs_IN) << c.name << f;
      }
    EXPECT_GT(tested, 0) << c.name;
  }
}

TEST(Project, NormalsAtVerticesAreThoseOfTheFace) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(10, 8, 2, 1.5));
  for (const int round : {1, 2}) {  // worked out, and remembered
    for (int e = 1; e <= model.edge_count(); ++e)
      for (const int f : model.edge(e).faces)
        for (const int v : model.edge(e).vertices) {
          const Vec3 normal = model.face_normal(f, model.project_to_face(f, model.vertex(v)).uv);
          EXPECT_EQ(model.vertex_normal(f, v), normal) << "round " << round << ", Face" << f << ", Vertex" << v;
        }
  }
}

TEST(Project, TangentsRunFromStartToEnd) {
  for (const Case& c : cases()) {
    const CadModel model = CadModel::from_brep(c.brep);
    for (int e = 1; e <= model.edge_count(); ++e) {
      if (model.edge(e).degenerate) continue;
      const auto [first, last] = model.edge_range(e);
      EXPECT_LT((model.edge_point(e, first) - model.vertex(model.edge(e).vertices[0])).norm(), 1e-6) << c.name << e;
      EXPECT_LT((model.edge_point(e, last) - model.vertex(model.edge(e).vertices[1])).norm(), 1e-6) << c.name << e;
      const double middle = (first + last) / 2, step = 1e-6 * (last - first);
      const Vec3 chord = (model.edge_point(e, middle + step) - model.edge_point(e, middle - step)).normalized();
      EXPECT_GT(chord.dot(model.edge_tangent(e, middle)), 1 - 1e-6) << c.name << e;
      EXPECT_EQ(model.edge_samples(e, 5).size(), 5u);
    }
  }
}

TEST(Project, BendsOfACylinderAndABall) {
  const double radius = 3;
  const CadModel cylinder = CadModel::from_brep(shapes::cylinder(radius, 5)), ball = CadModel::from_brep(shapes::sphere(radius));
  for (int f = 1; f <= cylinder.face_count(); ++f) {
    const FacePoint foot = cylinder.project_to_face(f, {2, 2.2, 1.3});
    const bool side = cylinder.face(f).kind == SurfaceKind::kCylinder;
    const Vec3 across = Vec3::UnitZ().cross(cylinder.face_normal(f, foot.uv));
    const Mat3 expected = side ? Mat3(-across * across.transpose() / radius) : Mat3(Mat3::Zero());
    EXPECT_LT((cylinder.face_bend(f, foot.uv) - expected).norm(), 1e-12);
  }
  for (int e = 1; e <= cylinder.edge_count(); ++e) {
    if (cylinder.edge(e).seam) continue;
    const EdgePoint foot = cylinder.project_to_edge(e, {2, 2.2, 1.3});
    const Vec3 inward(-foot.point[0], -foot.point[1], 0);
    EXPECT_LT((cylinder.edge_bend(e, foot.t) - inward / (radius * radius)).norm(), 1e-12);
  }
  const FacePoint foot = ball.project_to_face(1, {2, 2.2, 1.3});
  const Vec3 normal = ball.face_normal(1, foot.uv);
  EXPECT_LT((ball.face_bend(1, foot.uv) + (Mat3::Identity() - normal * normal.transpose()) / radius).norm(), 1e-12);
}

TEST(Project, ThreadsGetTheSameAnswers) {
  for (const std::string& brep : {shapes::loft(4, 5), shapes::filleted_box(10, 2)}) {
    const CadModel model = CadModel::from_brep(brep);
    const std::vector<Vec3> points = points_around(model, 300);
    const auto run = [&](std::vector<Vec3>& result) {
      for (const Vec3& p : points)
        for (int f = 1; f <= model.face_count(); ++f) result.push_back(model.project_to_face(f, p).point);
    };
    std::vector<Vec3> alone, first, second;
    run(alone);
    std::thread a([&] { run(first); }), b([&] { run(second); });
    a.join();
    b.join();
    EXPECT_EQ(alone, first);
    EXPECT_EQ(alone, second);
  }
}

}  // namespace
}  // namespace polycube
