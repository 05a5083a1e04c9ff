#include "pipeline/hex_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "support/polycubes.h"

namespace polycube {
namespace {

class HexMapFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / ("hex_map_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    std::set<testing::Place3> places;
    testing::add_box(places, {0, 0, 0}, {2, 2, 1});
    testing::remove_box(places, {1, 1, 0}, {2, 2, 1});
    example_ = testing::tetrahedralise(testing::voxels(places), 2);
    write_tets("tets.mesh", example_.tets.points);
    write_tets("map.mesh", example_.map.image);
    std::map<Triangle, int> label;
    for (const Chart& chart : example_.map.charts) {
      for (int t : chart.triangles) label[sorted(example_.tets.triangles[t])] = 2 * chart.axis + (chart.sign > 0 ? 0 : 1);
    }
    std::ofstream labels(path("labels"));
    for (const Tet& t : example_.tets.tets) {
      for (const Triangle& f : {Triangle{t[1], t[2], t[3]}, Triangle{t[0], t[2], t[3]}, Triangle{t[0], t[1], t[3]}, Triangle{t[0], t[1], t[2]}}) {
        const auto at = label.find(sorted(f));
        labels << (at == label.end() ? -1 : at->second) << '\n';
      }
    }
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static Triangle sorted(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }
  void write_tets(const std::string& name, const std::vector<Vec3>& points) const {
    std::ofstream out(path(name));
    out << "MeshVersionFormatted 2\nDimension 3\nVertices\n" << points.size() << '\n';
    for (const Vec3& p : points) out << p[0] << ' ' << p[1] << ' ' << p[2] << " 1\n";
    out << "Tetrahedra\n" << example_.tets.tets.size() << '\n';
    for (const Tet& t : example_.tets.tets) out << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << ' ' << t[3] + 1 << " 1\n";
    out << "End\n";
  }
  PolycuboidInput read() const { return read_polycuboid(path("tets.mesh"), path("labels"), path("map.mesh")); }

  std::filesystem::path folder_;
  testing::Example example_;
};

TEST_F(HexMapFiles, AreReadAndMeshed) {
  const PolycuboidInput input = read();
  EXPECT_EQ(input.map.charts.size(), example_.map.charts.size());
  HexMapOptions options;
  options.quantize.scale = 2;
  options.scale_by_tets = false;
  const HexMapResult result = hex_map(input, options, Monitor());
  EXPECT_EQ(result.blocks.blocks.size(), 3u);
  EXPECT_EQ(result.hexes.mesh.hexes.size(), 24u);
  const auto report = nlohmann::json::parse(report_json(input, result));
  EXPECT_EQ(report["hexes"], 24);
  EXPECT_EQ(report["optimal"], true);
  const auto problem = nlohmann::json::parse(problem_json(input, result));
  EXPECT_EQ(problem["axes"].size(), 3u);
  EXPECT_EQ(problem["vertex_unknowns"].size(), static_cast<std::size_t>(result.blocks.vertex_count));
  write_medit(path("out.mesh"), result.hexes);
  EXPECT_GT(std::filesystem::file_size(path("out.mesh")), 1000u);
}

TEST_F(HexMapFiles, ScaleZeroIsTheCoarsest) {
  HexMapOptions options;
  options.quantize.scale = 0;
  EXPECT_EQ(hex_map(read(), options, Monitor()).hexes.mesh.hexes.size(), 3u);
}

TEST_F(HexMapFiles, CoarsestIsSubdividedOnTheSameBlocks) {
  const PolycuboidInput input = read();
  HexMapOptions options;
  options.quantize.scale = 0;
  const HexMapResult coarse = hex_map(input, options, Monitor());
  EXPECT_EQ(coarse.cells, 3);
  EXPECT_EQ(coarse.hex_cell, (std::vector<int>{0, 1, 2}));
  options.quantize.structure = coarse.quantization.value;
  options.quantize.scale = 3;
  options.scale_by_tets = false;
  const HexMapResult fine = hex_map(input, coarse.blocks, options, Monitor());
  EXPECT_EQ(fine.blocks_seconds, 0);
  EXPECT_EQ(fine.hexes.mesh.hexes.size(), 3u * 27);
  EXPECT_EQ(fine.cells, 3);
  for (int cell = 0; cell < 3; ++cell) EXPECT_EQ(std::count(fine.hex_cell.begin(), fine.hex_cell.end(), cell), 27);
  write_vtu(path("out.vtu"), fine.hexes, fine.hex_cell);
  std::ifstream vtu(path("out.vtu"));
  const std::string text((std::istreambuf_iterator<char>(vtu)), std::istreambuf_iterator<char>());
  EXPECT_NE(text.find("Name=\"Block\""), std::string::npos);
  options.quantize.structure.clear();
  options.subdivide = true;
  EXPECT_EQ(hex_map(input, options, Monitor()).hexes.mesh.hexes, fine.hexes.mesh.hexes);
}

TEST_F(HexMapFiles, BadOnesAreRefused) {
  EXPECT_THROW(read_polycuboid(path("none.mesh"), path("labels"), path("map.mesh")), InvalidInput);
  std::ofstream(path("labels")) << "7\n";
  EXPECT_THROW(read(), InvalidInput);
  std::ofstream(path("map.mesh")) << "MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 0 1\nEnd\n";
  EXPECT_THROW(read(), InvalidInput);
}

}  // namespace
}  // namespace polycube
