// What the user sets by hand, the labels of CAD faces and the frame, is obeyed or refused with the reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <set>

#include "core/charts.h"
#include "core/error.h"
#include "pipeline/label_part.h"
#include "pipeline/pipeline.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using testing::HasSubstr;

LabelledPart labelled(const CadModel& model, const FaceLabels& labels, const FrameAxes& frame = {}) {
  MeshOptions options;
  options.labels = labels;
  options.frame = frame;
  return label_part(model, options, Monitor(), Until::kLabels);
}

std::string complaint(const CadModel& model, const FaceLabels& labels, const FrameAxes& frame = {}) {
  try {
    labelled(model, labels, frame);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

std::set<int> labels_of(const LabelledPart& part, int face) {
  std::set<int> found;
  for (std::size_t t = 0; t < part.tets.triangles.size(); ++t) {
    if (part.tets.triangle_face[t] == face) found.insert(part.labelling.label[t]);
  }
  return found;
}

/// The label whose direction a plane's normal has.
int label_of_plane(const LabelledPart& part, const CadModel& model, int face) {
  const Vec3 n = part.labelling.frame * model.face(face).axis;
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (n[axis] < 0);
}

int oblique_plane(const CadModel& model) {
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).kind == SurfaceKind::kPlane && model.face(f).axis.cwiseAbs().maxCoeff() < 0.9) return f;
  }
  return 0;
}

int face_of(const CadModel& model, SurfaceKind kind) {
  for (int f = 1; f <= model.face_count(); ++f) {
    if (model.face(f).kind == kind) return f;
  }
  return 0;
}

TEST(Steering, AChamferTakesEitherOfItsAxesAndNoOther) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 3));
  const int chamfer = oblique_plane(model);
  ASSERT_GT(chamfer, 0);
  const Vec3 n = model.face(chamfer).axis;
  int obeyed = 0;
  for (int label = 0; label < 6; ++label) {
    SCOPED_TRACE(label_name(label));
    if (label_sign(label) * n[label_axis(label)] > 0.5) {
      const LabelledPart part = labelled(model, {{chamfer, label}});
      EXPECT_EQ(labels_of(part, chamfer), std::set{label});
      EXPECT_TRUE(part.label_report.valid());
      ++obeyed;
    } else {
      const std::string text = complaint(model, {{chamfer, label}});
      EXPECT_THAT(text, HasSubstr("Face" + std::to_string(chamfer) + " cannot be " + label_name(label)));
      EXPECT_THAT(text, HasSubstr("it can be "));
      EXPECT_EQ(text.find('\n'), std::string::npos);
    }
  }
  EXPECT_EQ(obeyed, 2);
}

TEST(Steering, ATurnedChamferToo) {
  const CadModel model = CadModel::from_brep(shapes::moved(shapes::chamfered_box(10, 3), 77, 5, -40, 8));
  const LabelledPart free = labelled(model, {});
  int chamfer = 0;
  for (int f = 1; f <= model.face_count(); ++f) {
    if ((free.labelling.frame * model.face(f).axis).cwiseAbs().maxCoeff() < 0.9) chamfer = f;
  }
  ASSERT_GT(chamfer, 0);
  const Vec3 n = free.labelling.frame * model.face(chamfer).axis;
  for (int label = 0; label < 6; ++label) {
    if (label_sign(label) * n[label_axis(label)] > 0.5) {
      EXPECT_EQ(labels_of(labelled(model, {{chamfer, label}}), chamfer), std::set{label});
    }
  }
}

TEST(Steering, APlaneThatFacesTheOtherWayIsRefused) {
  const CadModel model = CadModel::from_brep(shapes::box(10, 20, 30));
  for (int face : {1, 4}) {
    const Vec3 n = model.face(face).axis;
    int axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    const int own = 2 * axis + (n[axis] < 0);
    const std::string text = complaint(model, {{face, own ^ 1}});
    EXPECT_THAT(text, HasSubstr("Face" + std::to_string(face) + " cannot be " + label_name(own ^ 1)));
    EXPECT_THAT(text, HasSubstr(std::string("it can be ") + label_name(own)));
  }
  MeshOptions options;
  options.labels = {{1, 4}};
  EXPECT_THROW(mesh(model, options, Monitor()), InvalidInput);
}

// In a frame 50 degrees off, every side of a box may go to either of two axes; all moved on by one is a valid labelling of its own.
TEST(Steering, ObliquePlanesAreTurnedOn) {
  const CadModel model = CadModel::from_brep(shapes::box(20, 20, 10));
  const double a = 50 * std::numbers::pi / 180;
  const FrameAxes frame{Vec3(std::cos(a), std::sin(a), 0), Vec3(-std::sin(a), std::cos(a), 0)};
  const LabelledPart free = labelled(model, {}, frame);
  FaceLabels next;
  for (int f = 1; f <= 6; ++f) {
    if (std::abs(model.face(f).axis[2]) > 0.5) continue;
    const Vec3 n = free.labelling.frame * model.face(f).axis;
    EXPECT_EQ(labels_of(free, f), std::set{label_of_plane(free, model, f)});
    const int other = 1 - label_axis(label_of_plane(free, model, f));
    next.emplace_back(f, 2 * other + (n[other] < 0));
  }
  const LabelledPart part = labelled(model, next, frame);
  for (const auto& [face, label] : next) EXPECT_EQ(labels_of(part, face), std::set{label});
  EXPECT_TRUE(part.label_report.valid());
}

TEST(Steering, RoundFaces) {
  const CadModel whole = CadModel::from_brep(shapes::cylinder(5, 12));
  const int barrel = face_of(whole, SurfaceKind::kCylinder);
  EXPECT_THAT(complaint(whole, {{barrel, 0}}), HasSubstr("turns against it; it turns too far for any one label"));
  EXPECT_THAT(complaint(whole, {{barrel, 4}}), HasSubstr("does not face that way"));

  // Half a turn, from -X over +Y to +X.
  const CadModel half = CadModel::from_brep(shapes::half_cylinder(6, 10));
  const int round = face_of(half, SurfaceKind::kCylinder);
  EXPECT_EQ(labels_of(labelled(half, {{round, 2}}), round), std::set{2});
  EXPECT_THAT(complaint(half, {{round, 0}}), HasSubstr("it can be +Y"));

  const CadModel rounded = CadModel::from_brep(shapes::filleted_box(10, 3));
  for (int f = 1; f <= rounded.face_count(); ++f) {
    if (rounded.face(f).kind != SurfaceKind::kCylinder) continue;
    // Away from the middle of the box, across the axis of the fillet: the two labels beside it.
    Vec3 out = rounded.face(f).centre - (rounded.box_min() + rounded.box_max()) / 2;
    out -= out.dot(rounded.face(f).axis) * rounded.face(f).axis;
    int possible = 0;
    for (int label = 0; label < 6; ++label) {
      if (label_sign(label) * out.normalized()[label_axis(label)] < 0.5) continue;
      EXPECT_EQ(labels_of(labelled(rounded, {{f, label}}), f), std::set{label});
      ++possible;
    }
    EXPECT_EQ(possible, 2);
    break;
  }
}

TEST(Steering, TheFrameIsTheOneGiven) {
  const CadModel model = CadModel::from_brep(shapes::moved(shapes::l_bracket(20, 5, 15), 33, 100, -50, 7));
  const Mat3 found = labelled(model, {}).labelling.frame;
  // Another right-handed order and length of the same axes.
  const LabelledPart part = labelled(model, {}, {3 * found.row(1).transpose(), -0.2 * found.row(0).transpose()});
  EXPECT_LT((part.labelling.frame.row(0) - found.row(1)).norm(), 1e-12);
  EXPECT_LT((part.labelling.frame.row(1) + found.row(0)).norm(), 1e-12);
  EXPECT_LT((part.labelling.frame.row(2) - found.row(2)).norm(), 1e-12);
  for (int f = 1; f <= model.face_count(); ++f) EXPECT_EQ(labels_of(part, f), std::set{label_of_plane(part, model, f)});
}

TEST(Steering, ReachesTheMesh) {
  const CadModel model = CadModel::from_brep(shapes::chamfered_box(10, 3));
  const int chamfer = oblique_plane(model);
  const Vec3 n = model.face(chamfer).axis;
  for (int label = 0; label < 6; ++label) {
    if (label_sign(label) * n[label_axis(label)] < 0.5) continue;
    MeshOptions options;
    options.labels = {{chamfer, label}};
    const MeshResult result = mesh(model, options, Monitor());
    EXPECT_GT(result.report.quality.min_scaled_jacobian, 0.1);
    EXPECT_TRUE(result.association.lost_edges.empty());
    EXPECT_EQ(result.report.options.labels, options.labels);
  }
  MeshOptions turned;
  turned.frame = {Vec3(1, 1, 0), Vec3(-1, 1, 0)};
  turned.size = 1;
  const MeshResult result = mesh(CadModel::from_brep(shapes::cylinder(5, 12)), turned, Monitor());
  EXPECT_GT(result.report.quality.min_scaled_jacobian, 0.3);
  ASSERT_EQ(result.report.options.frame.size(), 2u);
}

// Each of the four sides could have its axis, all together they leave two directions without any side.
TEST(Steering, AFailureNamesWhatWasSetByHand) {
  const double a = 50 * std::numbers::pi / 180;
  MeshOptions options;
  options.size = 5;
  options.frame = {Vec3(std::cos(a), std::sin(a), 0), Vec3(-std::sin(a), std::cos(a), 0)};
  options.labels = {{1, 2}, {2, 3}, {3, 3}, {4, 2}};
  try {
    mesh(CadModel::from_brep(shapes::box(20, 20, 10)), options, Monitor());
    FAIL() << "that has no mesh";
  } catch (const StageFailed& e) {
    EXPECT_THAT(e.what(), HasSubstr(", with Face1=+Y, Face2=-Y, Face3=-Y, Face4=+Y set by hand"));
  }
}

}  // namespace
}  // namespace polycube
