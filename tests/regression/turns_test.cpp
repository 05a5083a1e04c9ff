// However a part is turned, it gets the same labels: as many charts, and every CAD face the same directions as seen from the part.
// For CAD files: POLYCUBE_TURN_PARTS=A.step:B.step test_regression --gtest_filter='*Turns*'.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <random>
#include <sstream>

#include "core/charts.h"
#include "pipeline/inspect.h"
#include "support/shapes.h"

namespace polycube {
namespace {

constexpr int kTurns = 20;

Mat3 random_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  // In the order of the declarations; the arguments of a constructor would be drawn in any order.
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

/// Area (mm^2) of each CAD face by the direction of its labels, which is given in the coordinates of the part before its turn, rounded.
std::map<std::pair<int, std::array<int, 3>>, double> areas(const LabelledPart& part, const Mat3& turn) {
  std::map<std::pair<int, std::array<int, 3>>, double> found;
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    const int label = part.labelling.label[t];
    const Vec3 direction = 1000 * label_sign(label) * (turn.transpose() * part.labelling.frame.row(label_axis(label)).transpose());
    const auto& [a, b, c] = part.tets.triangles[t];
    const double area = (part.tets.points[b] - part.tets.points[a]).cross(part.tets.points[c] - part.tets.points[a]).norm() / 2;
    std::array<int, 3> key{};
    for (int k = 0; k < 3; ++k) key[k] = static_cast<int>(std::lround(direction[k]));
    found[{part.tets.triangle_face[t], key}] += area;
  }
  return found;
}

struct Part {
  std::string name;
  std::function<CadModel()> model;
};

std::vector<Part> parts() {
  const auto made = [](const char* name, const std::string& brep) { return Part{name, [brep] { return CadModel::from_brep(brep); }}; };
  std::vector<Part> list{made("Notch", shapes::notched_box(10)), made("Bore", shapes::plate_with_hole(30, 20, 6, 4)),
                         made("Chamfer", shapes::chamfered_box(10, 3))};
  const char* given = std::getenv("POLYCUBE_TURN_PARTS");
  std::istringstream files(given ? given : "");
  for (std::string file; std::getline(files, file, ':');) {
    std::string name = std::filesystem::path(file).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    list.push_back({name, [file] { return CadModel::read(file); }});
  }
  return list;
}

class Turns : public testing::TestWithParam<Part> {};

TEST_P(Turns, ChangeNoLabels) {
  const CadModel model = GetParam().model();
  const LabelledPart base = label_part(model, MeshOptions(), Monitor(), Until::kLabels);
  const int charts = inspect(base).charts;
  const auto expected = areas(base, Mat3::Identity());
  std::mt19937 random(1);
  for (int i = 0; i < kTurns; ++i) {
    SCOPED_TRACE("turn " + std::to_string(i));
    const Mat3 turn = random_turn(random);
    const LabelledPart part = label_part(model.transformed(turn, Vec3(3, -40, 5), 1, 0), MeshOptions(), Monitor(), Until::kLabels);
    EXPECT_EQ(inspect(part).charts, charts);
    EXPECT_LT((part.labelling.frame * part.labelling.frame.transpose() - Mat3::Identity()).norm(), 1e-9);
    const auto found = areas(part, turn);
    ASSERT_EQ(found.size(), expected.size());
    auto e = expected.begin();
    for (auto f = found.begin(); f != found.end(); ++f, ++e) {
      EXPECT_EQ(f->first, e->first);
      EXPECT_NEAR(f->second / e->second, 1, 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Turns, testing::ValuesIn(parts()), [](const auto& part) { return part.param.name; });

}  // namespace
}  // namespace polycube
