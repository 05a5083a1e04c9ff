// What the part itself asks for: elements round circles and through walls, none too long.
#include "pipeline/bounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "pipeline/circles.h"
#include "pipeline/pipeline.h"
#include "pipeline/shortfalls.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

int elements_on(const MeshResult& result, int edge) {
  return static_cast<int>(std::count(result.association.segment_edge.begin(), result.association.segment_edge.end(), edge));
}

int least_round(const CadModel& model, const MeshResult& result) {
  int least = std::numeric_limits<int>::max();
  for (int e = 1; e <= model.edge_count(); ++e) {
    if (model.edge(e).closed && !model.edge(e).seam) least = std::min(least, elements_on(result, e));
  }
  return least;
}

struct Logged {
  Logged() {
    monitor.on_log = [this](const std::string& line) { lines.push_back(line); };
  }
  Monitor monitor;
  std::vector<std::string> lines;
};

const RoundEdge* closed_one(const CadModel& model, const std::vector<RoundEdge>& edges) {
  for (const RoundEdge& r : edges) {
    if (model.edge(r.edge).closed) return &r;
  }
  return nullptr;
}

TEST(RoundEdges, TurnInProportion) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(40, 30, 3, 6));
  const std::vector<RoundEdge> rims = round_edges(plate, 12);
  ASSERT_EQ(rims.size(), 2u);
  for (const RoundEdge& r : rims) {
    EXPECT_EQ(r.elements, 12);
    EXPECT_NEAR(r.turn, 2 * std::numbers::pi, 1e-9);
    EXPECT_THAT(r.name, HasSubstr("12 elements round the bore"));
  }
  EXPECT_TRUE(round_edges(plate, 0).empty());
  const CadModel half = CadModel::from_brep(shapes::half_cylinder(5, 12));
  for (const RoundEdge& r : round_edges(half, 12)) EXPECT_EQ(r.elements, 6);
  EXPECT_EQ(round_edges(half, 12).size(), 2u);
  const CadModel rounded = CadModel::from_brep(shapes::filleted_box(10, 2));
  ASSERT_FALSE(round_edges(rounded, 12).empty());
  for (const RoundEdge& r : round_edges(rounded, 12)) {
    EXPECT_EQ(r.elements, 3);
    EXPECT_THAT(r.name, HasSubstr("3 elements along the arc"));
  }
  const CadModel shaft = CadModel::from_brep(shapes::cylinder(5, 12));
  EXPECT_THAT(closed_one(shaft, round_edges(shaft, 16))->name, HasSubstr("16 elements round the shaft"));
}

TEST(RoundEdges, SmallCirclesNeedFewer) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(400, 300, 3, 2));
  EXPECT_EQ(closed_one(plate, round_edges(plate, 12))->elements, 8);
  EXPECT_EQ(closed_one(plate, round_edges(plate, 6))->elements, 6);
}

TEST(RoundEdges, HalvesOfACircleAreOneBore) {
  const CadModel drilled = CadModel::from_brep(shapes::drilled_block());
  std::vector<std::string> names;
  for (const RoundEdge& r : round_edges(drilled, 12)) {
    names.push_back(r.name);
    EXPECT_EQ(r.elements, 6);
  }
  EXPECT_THAT(names, Contains(HasSubstr("12 elements round the bore")));
}

// The bore's rim got four mesh edges at this size, the plate one cell through it.
TEST(Bounds, HoldForTheSizeAskedFor) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(60, 50, 3, 4));
  MeshOptions options;
  options.size = 8;
  for (const int order : {1, 2}) {
    options.order = order;
    Logged logged;
    const MeshResult result = mesh(plate, options, logged.monitor);
    EXPECT_EQ(least_round(plate, result), 12);
    EXPECT_EQ(result.report.thin_walls, 0);
    EXPECT_EQ(result.report.coarse_circles, 0);
    EXPECT_TRUE(result.report.warnings.empty());
    EXPECT_TRUE(find_shortfalls(plate, result.mesh, result.association, order == 2 ? 2 : 3, 12).thin_walls.empty());
    EXPECT_EQ(find_shortfalls(plate, result.mesh, result.association, order == 2 ? 3 : 4, 12).thin_walls.size(), 1u);
    EXPECT_THAT(logged.lines, Contains(HasSubstr("12 elements round the bore")));
    EXPECT_THAT(logged.lines, Contains(HasSubstr(std::to_string(order == 2 ? 2 : 3) + " elements through every wall")));
  }
}

TEST(Bounds, AreSwitchedOff) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(60, 50, 3, 4));
  MeshOptions options;
  options.size = 8;
  options.per_circle = 0;
  options.min_layers = 1;
  const MeshResult result = mesh(plate, options, Monitor());
  EXPECT_LT(least_round(plate, result), 12);
  EXPECT_TRUE(result.report.warnings.empty());
  const Shortfalls missing = find_shortfalls(plate, result.mesh, result.association, 2, 12);
  EXPECT_THAT(missing.thin_walls, Contains(HasSubstr("1 element through the wall, not 2")));
  EXPECT_THAT(missing.coarse_circles, Contains(HasSubstr("not 12")));
}

TEST(Bounds, AutomaticSizeLeavesNoLongEdge) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(60, 50, 3, 4));
  const auto longest = [&](const MeshResult& result) {
    double most = 0;
    for (const Hex& h : result.mesh.hexes) {
      for (int k : {1, 3, 4}) most = std::max(most, (result.mesh.points[h[0]] - result.mesh.points[h[k]]).norm());
    }
    return most;
  };
  MeshOptions options;
  const MeshResult automatic = mesh(plate, options, Monitor());
  // Edges slide while cells are made better, and rings round the hole push them outwards: a seventh is allowed for that.
  EXPECT_LT(longest(automatic), 1.15 * plate.diagonal() / 15);
  options.max_size = plate.diagonal() / 25;
  const MeshResult finer = mesh(plate, options, Monitor());
  EXPECT_LT(longest(finer), 1.15 * options.max_size);
  EXPECT_GT(finer.report.hexes, automatic.report.hexes);
}

// What is asked for by name comes first, and the bounds elsewhere stay.
TEST(Bounds, YieldToDivisions) {
  const CadModel plate = CadModel::from_brep(shapes::plate_with_hole(60, 50, 3, 4));
  int rim = 0;
  for (int e = 1; e <= plate.edge_count(); ++e) {
    if (plate.edge(e).closed && !plate.edge(e).seam) rim = e;
  }
  MeshOptions options;
  options.divisions = {{rim, {}, 8, 8}};
  const MeshResult result = mesh(plate, options, Monitor());
  EXPECT_EQ(elements_on(result, rim), 8);
  EXPECT_EQ(result.report.thin_walls, 0);
  EXPECT_EQ(result.report.coarse_circles, 2);
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("8 elements round the curve, not 12")));
}

TEST(Bounds, OfManyShortfallsAFewAreTold) {
  const CadModel box = CadModel::from_brep(shapes::filleted_box(20, 5));
  MeshOptions options;
  for (const RoundEdge& arc : round_edges(box, 12)) options.divisions.push_back({arc.edge, {}, 2, 2});
  const MeshResult result = mesh(box, options, Monitor());
  EXPECT_EQ(result.report.coarse_circles, 24);
  EXPECT_EQ(result.report.warnings.size(), 5u);
  EXPECT_EQ(result.report.warnings.back(), "20 more CAD edges with fewer elements along them than their turning asks for");
}

// The wall's three layers are far thinner than the cells beside them: these grow from there, and the number asked for comes out all the same.
TEST(Bounds, CellsGrowAndTheirNumberIsMet) {
  const CadModel bracket = CadModel::from_brep(shapes::l_bracket(60, 4, 30));
  for (const int wanted : {600, 2000, 6000}) {
    MeshOptions options;
    options.hexes = wanted;
    const MeshResult result = mesh(bracket, options, Monitor());
    EXPECT_NEAR(result.report.hexes, wanted, 0.15 * wanted);
    EXPECT_EQ(result.report.thin_walls, 0);
  }
}

TEST(Bounds, BiasGrowsTheCellsAlongAnEdge) {
  const CadModel box = CadModel::from_brep(shapes::box(40, 10, 10));
  int edge = 0;
  for (int e = 1; e <= box.edge_count(); ++e) {
    if (box.edge(e).length > 39) edge = e;
  }
  ASSERT_GT(edge, 0);
  for (const double ratio : {2.0, 0.25}) {
    MeshOptions options;
    options.size = 4;
    options.bias = {{edge, ratio}};
    const MeshResult result = mesh(box, options, Monitor());
    std::vector<double> places;  // along the edge, from its start
    const Vec3 start = box.vertex(box.edge(edge).vertices[0]);
    for (std::size_t i = 0; i < result.association.segments.size(); ++i) {
      if (result.association.segment_edge[i] != edge) continue;
      for (const int n : result.association.segments[i]) places.push_back((result.mesh.points[n] - start).norm());
    }
    std::sort(places.begin(), places.end());
    const double first = places[1] - places[0] > 1e-9 ? places[1] - places[0] : places[2] - places[0];
    const auto end = places.end();
    const double last = end[-1] - end[-2] > 1e-9 ? end[-1] - end[-2] : end[-1] - end[-3];
    EXPECT_NEAR(last / first, ratio, 0.1 * ratio);
  }
}

}  // namespace
}  // namespace polycube
