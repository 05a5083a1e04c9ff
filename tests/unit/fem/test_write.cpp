#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "core/error.h"
#include "fem/fem.h"
#include "unit/fem/fixtures.h"

namespace polycube {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Write : public testing::Test {
 protected:
  Write() : folder_(fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Write() override { fs::remove_all(folder_); }

  static FemMesh box(int order) {
    const Example e = box_example(2);
    return build_fem_mesh(e.model, e.mesh, e.association, {.order = order, .threads = 1}, Monitor());
  }
  std::string written(const FemMesh& mesh, const std::string& file, const std::string& type = "C3D8") {
    write(mesh, (folder_ / file).string(), type, Monitor());
    std::ifstream stream(folder_ / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  fs::path folder_;
};

int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST_F(Write, InpHasSetsAndSurfacesForEveryEntity) {
  const std::string text = written(box(1), "a.inp");
  EXPECT_THAT(text, HasSubstr("*ELEMENT, TYPE=C3D8, ELSET=Eall\n"));
  EXPECT_EQ(count(text, "*NSET, NSET=Face"), 6);
  EXPECT_EQ(count(text, "*NSET, NSET=Edge"), 12);
  EXPECT_EQ(count(text, "*NSET, NSET=Vertex"), 8);
  EXPECT_EQ(count(text, "_Elements\n"), 6);
  EXPECT_EQ(count(text, "*ELSET, ELSET=Face"), 12);  // all of a box face's quads are the same side of their cells
  EXPECT_EQ(count(text, "*SURFACE, NAME=Face"), 6);
  EXPECT_EQ(count(text, ", S"), 24);  // one line a quad
  EXPECT_THAT(text, HasSubstr("*ELSET, ELSET=Solid1\n"));
}

TEST_F(Write, InpNamesAreAllDifferent) {
  // CalculiX takes a surface for the element set of its name, and a load on it goes nowhere.
  for (int order : {1, 2}) {
    const std::string text = written(box(order), "a.inp", order == 1 ? "C3D8" : "C3D20");
    std::set<std::string> names;
    for (const char* kind : {"NSET=", "ELSET=", "NAME="})
      for (auto at = text.find(kind); at != std::string::npos; at = text.find(kind, at + 1)) {
        if (text[at - 1] != ' ') continue;  // within another word
        const auto begin = at + std::strlen(kind);
        const std::string name = text.substr(begin, text.find_first_of(",\n", begin) - begin);
        EXPECT_TRUE(names.insert(name).second) << name;
      }
    EXPECT_EQ(names.size(), 2u + 8 + 12 + 6 * 4 + 2) << "Nall, Eall, vertices, edges, faces, the solid";
  }
}

TEST_F(Write, InpLinesHoldAtMostSixteenNumbers) {
  std::istringstream lines(written(box(2), "a.inp", "C3D20R"));
  int numbers = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '*') continue;
    EXPECT_LE(std::count(line.begin(), line.end(), ','), 16);
    EXPECT_LE(line.size(), 132u);
    ++numbers;
  }
  EXPECT_GT(numbers, 100);
}

TEST_F(Write, InpNumbersFitTheTwentyCharactersThatCalculiXReads) {
  FemMesh mesh = box(1);
  mesh.points[0] = Vec3(-1.2345678901234567e-17, -0.0012345678901234567, 1.0 / 3);
  std::istringstream lines(written(mesh, "a.inp"));
  std::string line;
  while (line.rfind("1, ", 0) != 0) ASSERT_TRUE(std::getline(lines, line));
  std::istringstream fields(line);
  std::getline(fields, line, ',');
  for (int k = 0; k < 3; ++k) {
    std::getline(fields, line, ',');
    EXPECT_LE(line.size(), 21u) << line;  // with the blank before it
    EXPECT_NEAR(std::stod(line) / mesh.points[0][k], 1, 1e-12);
  }
}

TEST_F(Write, InpRefusesATypeOfTheOtherOrder) { EXPECT_THROW(written(box(1), "a.inp", "C3D20"), InvalidInput); }

TEST_F(Write, EveryFormatGivesAFileAndNothingElse) {
  for (int order : {1, 2})
    for (const char* name : {"a.inp", "a.unv", "a.vtu", "a.med", "a.mesh"}) {
      EXPECT_FALSE(written(box(order), name, order == 1 ? "C3D8" : "C3D20").empty()) << name;
    }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 5);
}

TEST_F(Write, SameMeshSameBytes) {
  for (const char* suffix : {".inp", ".unv", ".vtu", ".mesh"})
    EXPECT_EQ(written(box(1), std::string("a") + suffix), written(box(1), std::string("b") + suffix));
}

TEST_F(Write, RefusesUnknownSuffixAndMissingFolder) {
  EXPECT_THROW(check_output((folder_ / "a.stl").string()), InvalidInput);
  EXPECT_THROW(check_output((folder_ / "none" / "a.inp").string()), InvalidInput);
  fs::create_directory(folder_ / "b.inp");
  EXPECT_THROW(check_output((folder_ / "b.inp").string()), InvalidInput);
  EXPECT_NO_THROW(check_output((folder_ / "a.inp").string()));
}

TEST_F(Write, CancelledLeavesNothing) {
  Monitor monitor;
  monitor.cancel();
  EXPECT_THROW(write(box(1), (folder_ / "a.inp").string(), "C3D8", monitor), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Write, UnvHasItsThreeDataSets) {
  const std::string text = written(box(2), "a.unv");
  for (const char* set : {"    -1\n  2411\n", "    -1\n  2412\n", "    -1\n  2467\n"}) EXPECT_EQ(count(text, set), 1) << set;
  EXPECT_THAT(text, HasSubstr("\nFace3\n"));
  EXPECT_THAT(text, HasSubstr("\nVertex2_Nodes\n"));
}

TEST_F(Write, MeditHasCornersOnlyAndCadReferences) {
  const std::string text = written(box(2), "a.mesh");
  EXPECT_THAT(text, HasSubstr("Vertices\n27\n"));
  EXPECT_THAT(text, HasSubstr("Hexahedra\n8\n"));
  EXPECT_THAT(text, HasSubstr("Quadrilaterals\n24\n"));
  EXPECT_THAT(text, HasSubstr("Corners\n8\n"));
}

}  // namespace
}  // namespace polycube
