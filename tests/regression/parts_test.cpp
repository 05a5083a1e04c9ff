// The whole way over parts that the tests make: complete, valid, good, on the CAD, and the same every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "cad/cad.h"
#include "core/error.h"
#include "label/label.h"
#include "pipeline/inspect.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"
#include "tet/tet.h"

namespace polycube {
namespace {

struct Part {
  std::string name, brep;
  double min_quality;
  std::size_t narrow = 0;  // charts that are narrower than triangles because the part wants them: ends of arcs that bound a segment
};

std::vector<Part> parts() {
  return {{"box", shapes::box(10, 20, 30), 0.99},
          {"cylinder", shapes::cylinder(5, 12), 0.5},
          {"sphere", shapes::sphere(5), 0.4},
          {"plate with hole", shapes::plate_with_hole(30, 20, 6, 4), 0.4},
          {"L bracket", shapes::l_bracket(20, 5, 15), 0.9},
          {"notched box", shapes::notched_box(10), 0.4},
          {"chamfered box", shapes::chamfered_box(10, 2), 0.3},
          {"bevelled box", shapes::bevelled_box(10, 2), 0.3},
          {"pyramid", shapes::pyramid(8, 6), 0.3},
          {"tetrahedron", shapes::tetrahedron(10), 0.3},
          {"cone", shapes::cone(5, 0, 12), 0.3},
          {"filleted box", shapes::filleted_box(10, 2), 0.5},
          {"half cylinder", shapes::half_cylinder(6, 10), 0.3},
          {"half lens", shapes::half_lens(40, 15), 0.3},
          {"rim divided by a point", shapes::divided_rim(5, 12, 5e-5), 0.5},
          {"bored web", shapes::bored_web(8, 32), 0.3, 2},
          {"claws", shapes::claws(20, 43), 0.4},
          {"ribbed cup", shapes::ribbed_cup(20), 0.4},
          {"turned L bracket", shapes::moved(shapes::l_bracket(20, 5, 15), 33, 100, -50, 7), 0.9}};
}

class Parts : public testing::TestWithParam<Part> {};

TEST_P(Parts, AreMeshedCompletely) {
  const CadModel model = CadModel::from_brep(GetParam().brep);
  const MeshResult result = mesh(model, MeshOptions(), Monitor());
  EXPECT_GE(result.report.quality.min_scaled_jacobian, GetParam().min_quality);
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_TRUE(result.association.lost_vertices.empty());
  EXPECT_EQ(result.association.patches.size(), static_cast<std::size_t>(model.face_count()));
  EXPECT_NEAR(result.report.volume / model.volume(), 1, 0.025);  // of straight cells: those at the cone's tip leave out the most
  for (std::size_t i = 0; i < result.mesh.points.size(); ++i) {
    const CadRef at = result.association.point_cad[i];
    const Vec3& p = result.mesh.points[i];
    double off = 0;
    if (at.dim == 0) off = (p - model.vertex(at.id)).norm();
    if (at.dim == 1) off = model.project_to_edge(at.id, p).distance;
    if (at.dim == 2) off = model.project_to_face(result.association.patches[at.id].front(), p).distance;
    EXPECT_LE(off, 1e-9 * model.diagonal());
  }
}

TEST(Pipeline, AConeHasItsTipOnANode) {
  const CadModel model = CadModel::from_brep(shapes::cone(5, 0, 12));
  const MeshResult result = mesh(model, MeshOptions(), Monitor());
  int tips = 0;
  for (std::size_t i = 0; i < result.mesh.points.size(); ++i) {
    if (result.association.point_cad[i].dim == 0) tips += (result.mesh.points[i] - Vec3(0, 0, 12)).norm() < 1e-9;
  }
  EXPECT_EQ(tips, 1);
}

INSTANTIATE_TEST_SUITE_P(Made, Parts, testing::ValuesIn(parts()), [](const auto& part) {
  std::string name = part.param.name;
  std::erase(name, ' ');
  return name;
});

TEST(Pipeline, TheSameMeshEveryTimeAndAtAnyThreadCount) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(30, 20, 6, 4));
  MeshOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const MeshResult a = mesh(model, one, Monitor()), b = mesh(model, two, Monitor());
  EXPECT_EQ(a.mesh.hexes, b.mesh.hexes);
  ASSERT_EQ(a.mesh.points.size(), b.mesh.points.size());
  for (std::size_t i = 0; i < a.mesh.points.size(); ++i) EXPECT_EQ(a.mesh.points[i], b.mesh.points[i]);
}

TEST(Pipeline, CoarsestIsCoarser) {
  const CadModel model = CadModel::from_brep(shapes::l_bracket(20, 5, 15));
  MeshOptions coarsest;
  coarsest.coarsest = true;
  const MeshResult a = mesh(model, MeshOptions(), Monitor()), b = mesh(model, coarsest, Monitor());
  EXPECT_EQ(b.report.hexes, 3);
  EXPECT_GT(a.report.hexes, 100);
}

// The default size is many times the wire's thickness.
TEST(Pipeline, AWireIsMeshed) {
  const MeshResult result = mesh(CadModel::from_brep(shapes::cylinder(1, 500)), MeshOptions(), Monitor());
  EXPECT_EQ(result.association.patches.size(), 3u);
  EXPECT_TRUE(result.association.lost_edges.empty());
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.3);
}

TEST(Pipeline, CancelAndBadOptionsEndIt) {
  const CadModel model = CadModel::from_brep(shapes::box(1, 1, 1));
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(mesh(model, MeshOptions(), monitor), Cancelled);
  MeshOptions options;
  options.size = 50;
  EXPECT_THROW(mesh(model, options, Monitor()), InvalidInput);
}

// Divided along their middle, or given to one side whole: the plane of symmetry between two fillets' rims is a chart boundary only if divided.
TEST(Labels, FilletsAreDividedUnlessToldOtherwise) {
  const CadModel model = CadModel::from_brep(shapes::filleted_box(10, 2));
  TetOptions size;
  size.size = 0.6;
  const TetMesh tets = tetrahedralise(model, size, Monitor());
  const auto labels_on_fillets = [&](double widest_bend) {
    TetMesh mesh = tets;
    LabelOptions options;
    options.widest_bend = widest_bend;
    const Labelling labelling = label(model, mesh, options, Monitor());
    std::map<int, std::set<int>> on;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) on[mesh.triangle_face[t]].insert(labelling.label[t]);
    std::multiset<std::size_t> counts;
    for (const auto& [face, labels] : on) {
      if (model.face(face).kind == SurfaceKind::kCylinder) counts.insert(labels.size());
    }
    return counts;
  };
  EXPECT_EQ(labels_on_fillets(LabelOptions{}.widest_bend).count(2), 12u);
  EXPECT_EQ(labels_on_fillets(0.96).count(1), 12u);
}

TEST(Labels, OfMadePartsAreValidAndMonotone) {
  for (const Part& p : parts()) {
    const LabelledPart labelled = label_part(CadModel::from_brep(p.brep), MeshOptions(), Monitor());
    EXPECT_TRUE(labelled.label_report.valid()) << p.name;
    EXPECT_EQ(labelled.label_report.turning_points, 0) << p.name;
    const Inspection found = inspect(labelled);
    EXPECT_TRUE(found.violations.valid()) << p.name;
    EXPECT_LE(found.stray_charts.size(), p.narrow) << p.name;
    // A few tets at the tips of boundaries may fold; the blocks read the map by its degree.
    EXPECT_LE(1000 * labelled.flipped, static_cast<int>(labelled.tets.tets.size())) << p.name;
  }
}

}  // namespace
}  // namespace polycube
