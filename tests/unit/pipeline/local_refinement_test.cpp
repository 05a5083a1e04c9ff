// Cells divided at places of the part, from the CAD to the mesh on it.
#include "pipeline/local_refinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/hexahedron.h"
#include "core/quality.h"
#include "fem/fem.h"
#include "pipeline/part_mesh.h"
#include "pipeline/pipeline.h"
#include "pipeline/session.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

int face_of(const CadModel& model, SurfaceKind kind) {
  for (const int f : model.faces()) {
    if (model.face(f).kind == kind) return f;
  }
  return 0;
}

int elements_on(const Association& association, int edge) {
  return static_cast<int>(std::count(association.segment_edge.begin(), association.segment_edge.end(), edge));
}

MeshOptions options_of(const char* refine) { return parse_options({{"refine", refine}}); }

/// Nodes stand on their CAD entities.
void expect_on_cad(const CadModel& model, const MeshResult& result) {
  const double near = 1e-7;
  for (std::size_t v = 0; v < result.mesh.points.size(); ++v) {
    const CadRef cad = result.association.point_cad[v];
    const Vec3& p = result.mesh.points[v];
    if (cad.dim == 0) {
      EXPECT_LT((model.vertex(cad.id) - p).norm(), near);
    } else if (cad.dim == 1) {
      EXPECT_LT(model.project_to_edge(cad.id, p).distance, near);
    } else if (cad.dim == 2) {
      double least = 1;
      for (const int f : result.association.patches[cad.id]) least = std::min(least, model.project_to_face(f, p).distance);
      EXPECT_LT(least, near);
    }
  }
}

/// Mean length of the mesh edges that leave a CAD face.
double depth_at(const MeshResult& result, int face) {
  std::vector<char> on(result.mesh.points.size(), 0);
  for (std::size_t q = 0; q < result.association.quads.size(); ++q) {
    if (result.association.patches[result.association.quad_patch[q]].front() != face) continue;
    for (const int n : result.association.quads[q]) on[n] = 1;
  }
  double sum = 0;
  int count = 0;
  for (const Hex& hex : result.mesh.hexes) {
    for (const auto& [c, d] : kHexEdges) {
      if (on[hex[c]] == on[hex[d]]) continue;
      sum += (result.mesh.points[hex[c]] - result.mesh.points[hex[d]]).norm();
      ++count;
    }
  }
  return sum / count;
}

// A hole of a fiftieth of the plate's width, 24 elements round it.
TEST(LocalRefinement, SmallHoleInAPlate) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(100, 100, 10, 1));
  const int bore = face_of(model, SurfaceKind::kCylinder);
  MeshOptions options = options_of(("Face" + std::to_string(bore) + "=1").c_str());
  options.per_circle = 8;
  Session session(model, options);
  const MeshResult result = session.mesh(options, Monitor());
  EXPECT_LE(result.mesh.hexes.size(), 3000u);
  // Cells that are divided stay as small as that, also beside larger ones.
  MeshOptions plain = options;
  plain.refine.clear();
  EXPECT_LT(depth_at(result, bore), 0.5 * depth_at(session.mesh(plain, Monitor()), bore));
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.25);
  EXPECT_THAT(result.association.lost_edges, IsEmpty());
  EXPECT_THAT(check(result.mesh, result.association), IsEmpty());
  for (const int e : model.edges()) {
    if (model.edge(e).closed && !model.edge(e).seam) {
      EXPECT_EQ(elements_on(result.association, e), 24);
    }
  }
  EXPECT_EQ(result.hex_block.size(), result.mesh.hexes.size());
  EXPECT_EQ(*std::min_element(result.hex_block.begin(), result.hex_block.end()), 0);
  expect_on_cad(model, result);
  // Second order and groups come after it.
  const FemMesh fem = build_fem_mesh(model, result.mesh, result.association, {.order = 2, .threads = 2}, Monitor());
  EXPECT_EQ(fem.hexes.size(), result.mesh.hexes.size());
}

TEST(LocalRefinement, TwoLevelsAtAnInnerEdge) {
  const CadModel model = CadModel::from_brep(shapes::l_bracket(30, 6, 12));
  int inner = 0;
  for (const int e : model.edges()) {
    if (model.edge(e).min_angle > 3.2) inner = e;
  }
  ASSERT_GT(inner, 0);
  const MeshResult plain = mesh(model, MeshOptions(), Monitor());
  const MeshResult result = mesh(model, options_of(("Edge" + std::to_string(inner) + "=2").c_str()), Monitor());
  EXPECT_EQ(elements_on(result.association, inner), 9 * elements_on(plain.association, inner));
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.25);
  EXPECT_THAT(check(result.mesh, result.association), IsEmpty());
  expect_on_cad(model, result);
}

TEST(LocalRefinement, IsTheSameAtAnyNumberOfThreadsAndWhereverThePartIs) {
  const std::string brep = shapes::plate_with_hole(20, 12, 4, 2);
  const CadModel model = CadModel::from_brep(brep);
  const int bore = face_of(model, SurfaceKind::kCylinder);
  MeshOptions options = options_of(("Face" + std::to_string(bore) + "=1,Vertex1=2").c_str());
  options.threads = 1;
  const MeshResult one = mesh(model, options, Monitor());
  options.threads = 3;
  const MeshResult three = mesh(model, options, Monitor());
  EXPECT_EQ(one.mesh.points, three.mesh.points);
  EXPECT_EQ(one.mesh.hexes, three.mesh.hexes);
  const MeshResult moved = mesh(CadModel::from_brep(shapes::moved(brep, 33, 5, -7, 2)), options, Monitor());
  EXPECT_EQ(one.mesh.hexes, moved.mesh.hexes);
  EXPECT_EQ(one.association.point_cad, moved.association.point_cad);
}

TEST(LocalRefinement, OfASessionIsThatOfItsOwnOptions) {
  const CadModel model = CadModel::from_brep(shapes::box(10, 8, 6));
  Session session(model, MeshOptions());
  const MeshResult plain = session.mesh(MeshOptions(), Monitor());
  const MeshResult refined = session.mesh(options_of("Face1=1"), Monitor());
  EXPECT_GT(refined.mesh.hexes.size(), plain.mesh.hexes.size());
  EXPECT_THROW(session.mesh(options_of("Solid1=6"), Monitor()), InvalidInput);  // too many cells
  EXPECT_THROW(session.mesh(options_of("Face7=1"), Monitor()), InvalidInput);
  EXPECT_EQ(session.mesh(MeshOptions(), Monitor()).mesh.hexes, plain.mesh.hexes);
}

TEST(LocalRefinement, TellsWhereItSpreadsAndRefusesASeam) {
  // The cells at a ball's surface are a shell round all others.
  const MeshResult result = mesh(CadModel::from_brep(shapes::sphere(5)), parse_options({{"size", "3"}, {"refine", "Face1=1"}}), Monitor());
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("only convex regions have templates")));
  EXPECT_THAT(check(result.mesh, result.association), IsEmpty());
  const CadModel model = CadModel::from_brep(shapes::cylinder(5, 10));
  for (const int e : model.edges()) {
    if (!model.edge(e).seam) continue;
    EXPECT_THROW(mesh(model, options_of(("Edge" + std::to_string(e) + "=1").c_str()), Monitor()), InvalidInput);
  }
}

TEST(LocalRefinement, OfSeveralSolids) {
  const std::string apart = shapes::compound(shapes::box(10, 8, 6), shapes::moved(shapes::box(10, 8, 6), 0, 20, 0, 0));
  const std::string touching = shapes::compound(shapes::box(10, 8, 6), shapes::moved(shapes::box(10, 8, 6), 0, 10, 0, 0));
  const auto meshed = [](const std::string& brep, const char* refine, const char* interfaces) {
    return mesh_part([&] { return Assembly::from_brep(brep); }, parse_options({{"coarsest", "true"}, {"refine", refine}, {"interfaces", interfaces}}),
                     Monitor());
  };
  const PartMesh refined = meshed(apart, "Solid2=1", "conform");
  ASSERT_EQ(refined.report.solids.size(), 2u);
  EXPECT_EQ(refined.report.solids[1].report.hexes, 27 * refined.report.solids[0].report.hexes);
  EXPECT_GT(meshed(touching, "Face1=1", "separate").report.solids[0].report.hexes, 8);
  // Face2 is the first box's at X = 10, Face7 the second's: one face, by either number.
  for (const char* interface : {"Face2=1", "Face7=1"}) {
    const PartMesh joined = meshed(touching, interface, "conform");
    EXPECT_EQ(joined.report.solids[0].report.hexes, joined.report.solids[1].report.hexes);
    EXPECT_GT(joined.report.solids[0].report.hexes, 8);
    for (const FemGroup& group : joined.fem.groups) {
      if (group.solid > 0 && group.other > 0) {
        EXPECT_GE(group.elements.size(), 9u);
      }
    }
  }
  const PartMesh beyond = meshed(touching, "Face1=1", "conform");
  EXPECT_LT(beyond.report.solids[1].report.hexes, beyond.report.solids[0].report.hexes);
}

TEST(RefinedBores, HaveTheLevelsThatFourElementsNeed) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(40, 30, 3, 6));
  const auto levels = [&](int per_circle) {
    const std::vector<RoundEdge> edges = round_edges(model, per_circle);
    const EdgeLevels found = levels_round_bores(edges);
    for (const RoundEdge& r : before_levels(edges, found)) EXPECT_GE(r.elements, 4);
    for (const RoundEdge& r : before_levels(edges, found)) EXPECT_LE(r.elements, 12);
    return found.empty() ? 0 : found.begin()->second;
  };
  EXPECT_EQ(levels(8), 0);
  EXPECT_EQ(levels(12), 1);
  EXPECT_EQ(levels(35), 1);
  EXPECT_EQ(levels(36), 2);
  const CadModel shaft = CadModel::from_brep(shapes::cylinder(5, 20));
  EXPECT_TRUE(levels_round_bores(round_edges(shaft, 36)).empty());
}

// Where its elements would go through the whole plate.
TEST(RefinedBores, AreChosenByThemselves) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(100, 100, 10, 1));
  MeshOptions options;
  options.per_circle = 24;
  Monitor monitor;
  std::string log;
  monitor.on_log = [&](const std::string& line) { log += line + "\n"; };
  const MeshResult result = mesh(model, options, monitor);
  EXPECT_THAT(log, HasSubstr("cells, the grid of the whole part 3360: by themselves"));
  EXPECT_LE(result.mesh.hexes.size(), 1000u);
  EXPECT_GE(result.report.quality.min_scaled_jacobian, 0.5);
  EXPECT_EQ(result.report.coarse_circles, 0);
  EXPECT_EQ(result.report.thin_walls, 0);
  EXPECT_THAT(result.association.lost_edges, IsEmpty());
  expect_on_cad(model, result);
  // Fewer elements go through the plate at a better price.
  log.clear();
  options.per_circle = 12;
  mesh(model, options, monitor);
  EXPECT_THAT(log, Not(HasSubstr("by themselves")));
}

}  // namespace
}  // namespace polycube
