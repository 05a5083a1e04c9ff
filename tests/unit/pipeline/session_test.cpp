// Meshes of one part that share what does not depend on counts and sizes.
#include "pipeline/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "core/error.h"
#include "pipeline/search/tuning.h"
#include "pipeline/trial_tuning.h"
#include "support/shapes.h"

namespace polycube {
namespace {

std::vector<std::string> stages(const MeshResult& result) {
  std::vector<std::string> names;
  for (const StageRecord& s : result.report.stages) names.push_back(s.name);
  return names;
}

bool equal(const MeshResult& a, const MeshResult& b) { return a.mesh.hexes == b.mesh.hexes && a.mesh.points == b.mesh.points; }

MeshOptions of_size(double size) {
  MeshOptions options;
  options.size = size;
  return options;
}

class Sessions : public ::testing::Test {
 protected:
  const CadModel plate_ = CadModel::from_brep(shapes::plate_with_hole(40, 30, 8, 6));
};

// Under a time limit a grid that would take longer than what is left gives way to the one with fewest cells, which is there in time.
TEST_F(Sessions, WithoutTimeForManyCellsTheSizeAloneDecides) {
  const auto plan_of = [&](bool limited) {
    Monitor monitor;
    if (limited) monitor.set_deadline(Monitor::Clock::now() + std::chrono::hours(1000));
    return mesh(plate_, {}, monitor).report.plan;
  };
  EXPECT_EQ(plan_of(true), "all CAD edges");
  set_tuning("search.cell_seconds=1e9");
  const std::string limited = plan_of(true), unlimited = plan_of(false);
  set_tuning("search.cell_seconds=3e-4");
  EXPECT_EQ(limited, "all CAD edges, the size alone");
  EXPECT_EQ(unlimited, "all CAD edges");
  EXPECT_EQ(kSearchTuning.cell_seconds, SearchTuning().cell_seconds);
}

TEST_F(Sessions, MapOnceForAllSizes) {
  Session session(plate_, {});
  session.prepare(Monitor());
  const MeshResult first = session.mesh({}, Monitor());
  EXPECT_TRUE(equal(first, mesh(plate_, {}, Monitor())));
  MeshOptions divided = of_size(3);
  divided.divisions = {{1, {}, 7, 7}};
  for (const MeshOptions& options : {of_size(2), of_size(5), divided}) {
    const MeshResult again = session.mesh(options, Monitor());
    EXPECT_THAT(stages(again), ::testing::Not(::testing::Contains(::testing::AnyOf("tet", "deform", "blocks"))));
    EXPECT_THAT(stages(again), ::testing::Contains("quantize"));
  }
  EXPECT_TRUE(equal(first, session.mesh({}, Monitor())));  // what was meshed in between leaves no trace
}

TEST_F(Sessions, OtherLabelsAreAnotherMap) {
  Session session(plate_, {});
  const MeshResult first = session.mesh({}, Monitor());
  MeshOptions turned;
  turned.frame = {Vec3(1, 1, 0), Vec3(-1, 1, 0)};
  const MeshResult other = session.mesh(turned, Monitor());
  EXPECT_THAT(stages(other), ::testing::Contains("deform"));
  EXPECT_TRUE(equal(other, mesh(plate_, turned, Monitor())));
  EXPECT_TRUE(equal(first, session.mesh({}, Monitor())));
}

// Labels on the tets that are there: those that label_part() makes.
TEST_F(Sessions, LabelsOnTheSameTets) {
  Session session(plate_, {});
  const LabelledPart first = session.labels({}, Monitor());
  const LabelledPart alone = label_part(plate_, {}, Monitor(), Until::kLabels);
  EXPECT_EQ(first.tets.points, alone.tets.points);
  EXPECT_EQ(first.labelling.label, alone.labelling.label);
  MeshOptions other;
  const int plane = first.tets.triangle_face.front();
  other.labels = {{plane, first.labelling.label.front()}};
  const LabelledPart second = session.labels(other, Monitor());
  for (const StageRecord& s : second.stages) EXPECT_NE(s.name, "tet");
  EXPECT_EQ(second.labelling.label, label_part(plate_, other, Monitor(), Until::kLabels).labelling.label);
  const LabelledPart mapped = session.labels({}, Monitor(), Until::kMap);
  EXPECT_EQ(mapped.labelling.label, first.labelling.label);
  EXPECT_EQ(mapped.map.image.size(), mapped.tets.points.size());
  EXPECT_TRUE(equal(session.mesh({}, Monitor()), mesh(plate_, {}, Monitor())));
}

// What is told beforehand is what comes, where the first plan gives the mesh.
TEST_F(Sessions, CountWithoutAFit) {
  Session session(plate_, {});
  MeshOptions divided = of_size(3), refined = of_size(8), counted;
  divided.divisions = {{1, {}, 7, 7}};
  refined.refine = {{{1, 1}, 2}};
  counted.hexes = 900;
  for (const MeshOptions& options : {MeshOptions(), of_size(2), divided, refined, counted}) {
    const int told = session.count(options, Monitor());
    const int made = session.mesh(options, Monitor()).report.hexes;
    EXPECT_NEAR(told, made, 0.15 * made);
  }
  MeshOptions wrong;
  wrong.divisions = {{99, {}, 2, 2}};
  EXPECT_THROW(session.count(wrong, Monitor()), InvalidInput);
}

// Stopped while the map is made, it is made again.
TEST_F(Sessions, GoOnAfterACancel) {
  Session session(plate_, {});
  Monitor stopping;
  stopping.on_progress = [&](const std::string& stage, double) {
    if (stage == "deform") stopping.cancel();
  };
  EXPECT_THROW(session.mesh({}, stopping), Cancelled);
  EXPECT_TRUE(equal(session.mesh({}, Monitor()), mesh(plate_, {}, Monitor())));
}

TEST_F(Sessions, RefuseWhatThePartHasNot) {
  Session session(plate_, {});
  MeshOptions options;
  options.divisions = {{99, {}, 2, 2}};
  EXPECT_THROW(session.mesh(options, Monitor()), InvalidInput);
  EXPECT_THROW(Session(plate_, options), InvalidInput);
  EXPECT_GT(session.mesh({}, Monitor()).report.hexes, 0);
}

}  // namespace
}  // namespace polycube
