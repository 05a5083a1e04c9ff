#include "label/choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "label/frame.h"
#include "support/shapes.h"
#include "tet/tet.h"

namespace polycube {
namespace {

struct Part {
  explicit Part(const std::string& brep) : model(CadModel::from_brep(brep)), frames(find_frames(model, 3)) {
    TetOptions size;
    size.size = model.diagonal() / 15;
    mesh = tetrahedralise(model, size, monitor);
  }
  LabelChoice choice() const {
    return {model, mesh, LabelOptions(), frames, true, std::vector<char>(static_cast<std::size_t>(model.edge_count()) + 1, 0), monitor};
  }
  Monitor monitor;
  CadModel model;
  std::vector<Mat3> frames;
  TetMesh mesh;
};

TEST(LabelChoice, OneWithoutFaultsEndsTheSearch) {
  const Part part(shapes::cylinder(5, 10));
  LabelChoice choice = part.choice();
  const std::vector<LabelVariant> order = choice.order();
  EXPECT_EQ(order.front(), LabelVariant());
  const Labelled& best = choice.labelled(order.front());
  EXPECT_EQ(best.faults, 0);
  EXPECT_EQ(best.report.charts, 6);
  EXPECT_EQ(best.labelling.label.size(), best.mesh.triangles.size());
  EXPECT_EQ(&choice.labelled(order.front()), &best);  // made once
  for (const LabelVariant& v : order) EXPECT_EQ(choice.labelled(v).report.charts, 6);
}

TEST(LabelChoice, OffersWhatTheShapeGivesAChoiceOf) {
  const auto count = [](LabelChoice choice, const auto& which) {
    const std::vector<LabelVariant>& order = choice.order();
    return std::count_if(order.begin(), order.end(), which);
  };
  const auto bends = [](const LabelVariant& v) { return v.widest_bend != LabelVariant().widest_bend; };
  const auto chamfers = [](const LabelVariant& v) { return v.chamfer_axis >= 0; };
  const auto framed = [](const LabelVariant& v) { return v.frame > 0; };
  const Part cylinder(shapes::cylinder(5, 10)), bevelled(shapes::chamfered_box(10, 3)), rounded(shapes::filleted_box(10, 2));
  EXPECT_EQ(count(cylinder.choice(), bends), 0);
  EXPECT_EQ(count(cylinder.choice(), chamfers), 0);
  EXPECT_EQ(count(cylinder.choice(), framed), 0);
  EXPECT_EQ(count(bevelled.choice(), bends), 0);
  EXPECT_EQ(count(bevelled.choice(), chamfers), 2);
  EXPECT_EQ(count(bevelled.choice(), framed), 1);
  EXPECT_GT(count(rounded.choice(), bends), 0);
  EXPECT_EQ(count(rounded.choice(), bends) * 2 + 1, static_cast<std::ptrdiff_t>(rounded.choice().order().size()));  // twins, but the one without room
  EXPECT_EQ(count(rounded.choice(), chamfers), 0);
}

TEST(LabelChoice, FacingLabelsTreatBentFacesAsTheFirstDoes) {
  const Part rounded(shapes::filleted_box(10, 2));
  const LabelVariant narrow, wide{.widest_bend = 1};
  const auto bends = [&](const LabelVariant& like) {
    std::vector<double> result;
    for (const LabelVariant& v : rounded.choice().facing(like)) {
      EXPECT_TRUE(v.facing);
      result.push_back(v.widest_bend);
    }
    return result;
  };
  const std::vector<double> alike = bends(narrow), both = bends(wide);
  EXPECT_EQ(alike, std::vector<double>(alike.size(), narrow.widest_bend));
  std::vector<double> wanted(alike.size(), wide.widest_bend);
  wanted.insert(wanted.end(), alike.begin(), alike.end());
  EXPECT_EQ(both, wanted);
}

}  // namespace
}  // namespace polycube
