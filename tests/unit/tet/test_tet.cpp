#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "core/error.h"
#include "support/shapes.h"
#include "tet/classify.h"
#include "tet/process.h"
#include "tet/sizes.h"
#include "tet/split.h"
#include "tet/tet.h"

namespace polycube {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double volume(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) sum += signed_volume(mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])], mesh.points[at(t[3])]);
  return sum;
}

/// Every failed setting logs a line: these parts must come out at the first, or a fault of the worker would pass for one of Gmsh.
TetMesh mesh_of(const CadModel& model, double pieces = 12) {
  TetOptions options;
  options.size = model.diagonal() / pieces;
  Monitor monitor;
  std::vector<std::string> log;
  monitor.on_log = [&](const std::string& line) { log.push_back(line); };
  TetMesh mesh = tetrahedralise(model, options, monitor);
  EXPECT_THAT(log, ::testing::SizeIs(1));
  return mesh;
}

/// Everything the header promises, measured against the CAD.
void expect_classified(const TetMesh& mesh, const CadModel& model) {
  EXPECT_THAT(check(mesh), IsEmpty());
  EXPECT_NO_THROW(check_complete(mesh, model));
  const double near = 1e-6 * model.diagonal();
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const CadRef& cad = mesh.point_cad[i];
    if (cad.dim == 0) {
      EXPECT_LT((model.vertex(cad.id) - mesh.points[i]).norm(), near);
    }
    if (cad.dim == 1) {
      EXPECT_LT(model.project_to_edge(cad.id, mesh.points[i]).distance, near);
    }
    if (cad.dim == 2) {
      EXPECT_LT(model.project_to_face(cad.id, mesh.points[i]).distance, near);
    }
  }
  std::map<int, double> area, length;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vec3 a = mesh.points[at(t[0])], b = mesh.points[at(t[1])], c = mesh.points[at(t[2])];
    const Vec3 cross = (b - a).cross(c - a);
    area[mesh.triangle_face[i]] += cross.norm() / 2;
    const FacePoint foot = model.project_to_face(mesh.triangle_face[i], (a + b + c) / 3);
    EXPECT_GT(cross.normalized().dot(model.face_normal(mesh.triangle_face[i], foot.uv)), 0.5);
  }
  for (int f = 1; f <= model.face_count(); ++f) EXPECT_NEAR(area[f], model.face(f).area, 0.15 * model.face(f).area) << f;
  for (std::size_t i = 0; i < mesh.segments.size(); ++i)
    length[mesh.segment_edge[i]] += (mesh.points[at(mesh.segments[i][0])] - mesh.points[at(mesh.segments[i][1])]).norm();
  for (int e = 1; e <= model.edge_count(); ++e)
    if (!model.edge(e).degenerate) {
      EXPECT_NEAR(length[e], model.edge(e).length, 0.1 * model.edge(e).length) << e;
    }
}

TEST(Tet, ClassifiesPrimitives) {
  for (const std::string& brep : {shapes::box(1, 2, 3), shapes::cylinder(1, 2), shapes::cone(2, 0, 3), shapes::sphere(1.5), shapes::torus(3, 1),
                                  shapes::plate_with_hole(10, 8, 2, 1.5), shapes::l_bracket(10, 2, 5), shapes::filleted_box(10, 2), shapes::half_cylinder(2, 3),
                                  shapes::loft(4, 5), shapes::hollow_box(10), shapes::chamfered_box(10, 0.4)}) {
    const CadModel model = CadModel::from_brep(brep);
    const TetMesh mesh = mesh_of(model);
    expect_classified(mesh, model);
    EXPECT_NEAR(volume(mesh), model.volume(), 0.05 * model.volume());
  }
}

TEST(Tet, ThinPartsHaveInnerPoints) {
  const CadModel plate = CadModel::from_brep(shapes::box(20, 20, 0.3));
  const TetMesh mesh = mesh_of(plate, 20);
  expect_classified(mesh, plate);
  EXPECT_NEAR(volume(mesh), plate.volume(), 1e-9 * plate.volume());
}

TEST(Tet, ScalesWithThePart) {
  const std::string brep = shapes::plate_with_hole(10, 8, 2, 1.5);
  const CadModel small = CadModel::from_brep(brep), large = CadModel::from_brep(shapes::scaled(brep, 1000)),
                 tiny = CadModel::from_brep(shapes::scaled(brep, 1e-3));
  const std::size_t count = mesh_of(small).tets.size();
  EXPECT_NEAR(static_cast<double>(mesh_of(large).tets.size()), static_cast<double>(count), 0.05 * static_cast<double>(count));
  EXPECT_NEAR(static_cast<double>(mesh_of(tiny).tets.size()), static_cast<double>(count), 0.05 * static_cast<double>(count));
}

TEST(Tet, SameInputSameMesh) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(10, 8, 2, 1.5));
  const TetMesh a = mesh_of(model), b = mesh_of(model);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_face, b.triangle_face);
}

TEST(Tet, FindsEntitiesThatGmshNumbersOtherwise) {
  const CadModel model = CadModel::from_brep(shapes::plate_with_hole(10, 8, 2, 1.5));
  // A raw mesh from the classified one, with every tag reversed.
  const TetMesh mesh = mesh_of(model);
  RawMesh raw;
  raw.points = mesh.points;
  raw.tets = mesh.tets;
  raw.triangles = mesh.triangles;
  raw.segments = mesh.segments;
  const std::array<int, 4> count{model.vertex_count(), model.edge_count(), model.face_count(), 1};
  for (const CadRef& cad : mesh.point_cad) raw.point_entity.push_back({cad.dim, count[at(cad.dim)] + 1 - cad.id});
  for (const int f : mesh.triangle_face) raw.triangle_tag.push_back(count[2] + 1 - f);
  for (const int e : mesh.segment_edge) raw.segment_tag.push_back(count[1] + 1 - e);
  const TetMesh again = classify(raw, model);
  EXPECT_EQ(again.point_cad, mesh.point_cad);
  EXPECT_EQ(again.segment_edge, mesh.segment_edge);
  std::map<Triangle, int> face_of;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Triangle t = mesh.triangles[i];
    std::sort(t.begin(), t.end());
    face_of[t] = mesh.triangle_face[i];
  }
  for (std::size_t i = 0; i < again.triangles.size(); ++i) {
    Triangle t = again.triangles[i];
    std::sort(t.begin(), t.end());
    EXPECT_EQ(again.triangle_face[i], face_of[t]);
  }
}

TEST(Tet, CheckFindsDamage) {
  const CadModel model = CadModel::from_brep(shapes::box(1, 2, 3));
  const TetMesh good = mesh_of(model, 5);
  TetMesh bad = good;
  std::swap(bad.tets[3][0], bad.tets[3][1]);
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  bad.triangles.pop_back();
  bad.triangle_face.pop_back();
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  std::swap(bad.triangles[0][0], bad.triangles[0][1]);
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  bad.tets.pop_back();
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  bad.triangle_face[0] = 0;
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  bad.point_cad[at(good.triangles[0][0])] = {3, 1};
  EXPECT_THAT(check(bad), Not(IsEmpty()));
  bad = good;
  for (int& face : bad.triangle_face) face = std::max(face, 2);
  EXPECT_THROW(check_complete(bad, model), Unusable);
}

TEST(Split, LeavesNoStuckTets) {
  // One tetrahedron, and two on a common facet: nothing but boundary points.
  const CadModel model = CadModel::from_brep(shapes::box(1, 1, 1));
  TetMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.point_cad.assign(5, CadRef{2, 1});
  mesh.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  for (Tet& t : mesh.tets)
    if (signed_volume(mesh.points[at(t[0])], mesh.points[at(t[1])], mesh.points[at(t[2])], mesh.points[at(t[3])]) < 0) std::swap(t[2], t[3]);
  mesh.triangles = boundary_facets(mesh.tets);
  mesh.triangle_face.assign(mesh.triangles.size(), 1);
  const double before = volume(mesh);
  split_for_map(mesh, model, Monitor());
  EXPECT_THAT(check(mesh), IsEmpty());
  EXPECT_EQ(mesh.tets.size(), 6u);
  EXPECT_NEAR(volume(mesh), before, 1e-15);
}

TEST(Sizes, FollowCurvatureWithinBounds) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(100, 80, 10, 5));
  const EntitySizes sizes = entity_sizes(plate, 8, 12);
  for (int f = 1; f <= plate.face_count(); ++f) {
    const bool bore = plate.face(f).kind == SurfaceKind::kCylinder;
    EXPECT_NEAR(sizes.faces[at(f - 1)], bore ? 2 * 3.14159265 * 5 / 12 : 8.0, 1e-6);
  }
  for (int e = 1; e <= plate.edge_count(); ++e) EXPECT_EQ(sizes.edges[at(e - 1)] < 8, plate.edge(e).seam || plate.edge(e).closed);
  const EntitySizes coarse = entity_sizes(plate, 30, 12);
  EXPECT_DOUBLE_EQ(*std::min_element(coarse.faces.begin(), coarse.faces.end()), 5.0);
  const EntitySizes off = entity_sizes(plate, 8, 0);
  EXPECT_DOUBLE_EQ(*std::min_element(off.edges.begin(), off.edges.end()), 8.0);
}

// The size follows the length of a wire, but its barrel has to keep enough elements round it to be told from a plate.
TEST(Sizes, AMainFaceMayBeFiner) {
  const CadModel wire = CadModel::from_brep(shapes::cylinder(1, 500));
  const double size = 500.0 / 30;
  const EntitySizes sizes = entity_sizes(wire, size, 12);
  for (int f = 1; f <= wire.face_count(); ++f) {
    if (wire.face(f).kind != SurfaceKind::kCylinder) continue;
    EXPECT_LT(sizes.faces[at(f - 1)], 2 * 3.14159265 / 8);
    EXPECT_DOUBLE_EQ(sizes.least, sizes.faces[at(f - 1)]);
  }
  // However long it is, the number of elements stays bounded.
  const EntitySizes longer = entity_sizes(CadModel::from_brep(shapes::cylinder(1, 50000)), 50000.0 / 30, 12);
  EXPECT_GT(longer.least, 5);
}

/// A script in the worker's place.
class FakeWorker {
 public:
  explicit FakeWorker(const std::string& body)
      : real_(find_worker()),
        path_(std::filesystem::path(::testing::TempDir()) / ("fake-polycube-tet-" + std::to_string(getpid()))),
        count_(path_.string() + ".count") {
    std::filesystem::remove(count_);
    std::ofstream(path_) << "#!/bin/sh\necho x >> '" << count_.string() << "'\nattempt=$(wc -l < '" << count_.string() << "')\nreal='" << real_ << "'\n"
                         << body << "\n";
    chmod(path_.c_str(), 0700);
    setenv("POLYCUBE_TET_WORKER", path_.c_str(), 1);
  }
  ~FakeWorker() {
    unsetenv("POLYCUBE_TET_WORKER");
    std::filesystem::remove(path_);
    std::filesystem::remove(count_);
  }
  int attempts() const {
    std::ifstream in(count_);
    return static_cast<int>(std::count(std::istreambuf_iterator<char>(in), {}, '\n'));
  }

 private:
  std::string real_;
  std::filesystem::path path_, count_;
};

TetOptions coarse(const CadModel& model) {
  TetOptions options;
  options.size = model.diagonal() / 5;
  return options;
}

TEST(Ladder, ClimbsPastCrashesAndSilence) {
  const FakeWorker worker(
      "case $attempt in 1) kill -SEGV $$;; 2) echo broken >&2; exit 1;; 3) exit 0;; 4) echo junk > \"$3\"; exit 0;; *) exec \"$real\" \"$@\";; esac");
  const CadModel model = CadModel::from_brep(shapes::box(1, 2, 3));
  Monitor monitor;
  std::vector<std::string> log;
  monitor.on_log = [&](const std::string& line) { log.push_back(line); };
  const TetMesh mesh = tetrahedralise(model, coarse(model), monitor);
  EXPECT_EQ(worker.attempts(), 5);
  EXPECT_THAT(check(mesh), IsEmpty());
  ASSERT_EQ(log.size(), 5u);
  EXPECT_THAT(log[0], HasSubstr("signal 11"));
  EXPECT_THAT(log[1], HasSubstr("broken"));
}

// The first waits for ever, the second works for ever.
TEST(Ladder, StopsHangingAttempts) {
  const FakeWorker worker("[ $attempt -gt 2 ] && exec \"$real\" \"$@\"; [ $attempt -gt 1 ] && while :; do :; done; exec sleep 1000");
  const CadModel model = CadModel::from_brep(shapes::box(1, 2, 3));
  TetOptions options = coarse(model);
  options.attempt_limit = 2;
  EXPECT_THAT(check(tetrahedralise(model, options, Monitor())), IsEmpty());
  EXPECT_EQ(worker.attempts(), 3);
}

TEST(Ladder, FailsWithTheStage) {
  const FakeWorker worker("echo no luck >&2; exit 1");
  const CadModel model = CadModel::from_brep(shapes::box(1, 2, 3));
  try {
    tetrahedralise(model, coarse(model), Monitor());
    FAIL() << "no exception";
  } catch (const StageFailed& failure) {
    EXPECT_EQ(failure.stage(), "tet");
    EXPECT_THAT(failure.what(), HasSubstr("no luck"));
  }
}

// Gmsh cannot be made to mesh it, and the other settings would only take the user's time.
TEST(Ladder, RefusesASolidThatCrossesItself) {
  const CadModel model = CadModel::from_brep(shapes::crossed_box(10));
  try {
    mesh_of(model);
    FAIL() << "meshed";
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("touches or crosses itself at Face"));
  }
}

TEST(Ladder, CancelsAtOnce) {
  const FakeWorker worker("exec sleep 1000");
  const CadModel model = CadModel::from_brep(shapes::box(1, 2, 3));
  Monitor monitor;
  monitor.set_deadline(Monitor::Clock::now() + std::chrono::milliseconds(200));
  EXPECT_THROW(tetrahedralise(model, coarse(model), monitor), Cancelled);
  Monitor pressed;
  std::thread button([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    pressed.cancel();
  });
  EXPECT_THROW(tetrahedralise(model, coarse(model), pressed), Cancelled);
  button.join();
}

}  // namespace
}  // namespace polycube
