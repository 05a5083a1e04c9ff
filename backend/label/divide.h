// Where faces that may have to take two labels are divided, when the usual place (half way down their slope, or not at all) leaves a
// labelling invalid.
#pragma once

#include "cad/cad.h"
#include "core/mesh.h"
#include "core/monitor.h"

namespace polycube {

/// Of the two parts of a cone that is cut across its axis, the one that faces along the axis; the other faces sideways.
enum class ConePart { kNone, kLower, kUpper };

/// A straight cut through an oblique plane or a bent face: `share` of its extent along `across` lies below. The usual way where `across` is zero.
struct FaceCut {
  Vec3 across = Vec3::Zero();  ///< in the frame of the labels, unit
  double share = 0.5;
  double upper = 1;                  ///< share below a second cut, beyond which a third part lies; 1: there is none
  bool thirds = false;               ///< instead: three parts that meet in its middle, as the faces of a cube do in a corner
  bool exact = false;                ///< the mesh is cut there beforehand (cut_faces): the parts may be narrower than its triangles
  ConePart level = ConePart::kNone;  ///< of a cone
};

/// The part (0, 1, 2: the axis that it faces) of a plane divided in thirds, `way` from its middle.
int third_at(const Vec3& normal, const Vec3& way);
/// Positive where that part lies, beside its border with another part.
double third_side(const Vec3& normal, const Vec3& way, int part, int other);

/// Ways to divide an oblique plane with this normal so that each part can face an axis of its own: at some shares of its extent, and half way between CAD
/// vertices that follow each other across it, since what ends on it there may need one side for itself. `vertices`: of its border; all in the frame.
std::vector<FaceCut> plane_cuts(const Vec3& normal, const std::vector<Vec3>& vertices);

/// Ways to divide a cone round an axis of the frame in two rings, of which one faces along the axis: the hypotenuse of a section that is turned round the axis,
/// such as a weld's. None where the cone is all but a cylinder or a disc. `axis`: its own, in the frame; `along`: share of it in the cone's normals.
std::vector<FaceCut> cone_cuts(const Vec3& axis, double along);
/// Where a face is cut, along `cut.across`.
double cut_middle(const TetMesh& mesh, int face, const FaceCut& cut, const Mat3& frame);

/// The mesh cut where `cuts` (per CAD face) are exact.
TetMesh cut_faces(TetMesh mesh, const std::vector<FaceCut>& cuts, const Mat3& frame, const Monitor& monitor);

/// Ways to divide a bent face (a side of a lens, of a wing) across the axis along which its normal turns, so that one part can face that axis. `mean`: its mean
/// normal, `turning`: how far its normals are from it along each axis, both in the frame.
std::vector<FaceCut> bent_cuts(const Vec3& mean, const Vec3& turning);

/// Faces that end in a point (CadEdge::tip), divided in four round the axis nearest to the tip's direction, and half way up to
/// the tip: like the side of a pyramid they may have to take other labels at the tip than below.
struct Tips {
  bool any = false;
  std::vector<Vec3> axis;   ///< per CAD face: that axis, in the frame; zero without tip
  TetMesh mesh;             ///< cut along the divisions
  std::vector<int> label;   ///< per triangle of it: the label across the axis that its quarter turns to; -1 on other faces
  std::vector<char> upper;  ///< per triangle: it is in the half at the tip
};
Tips divide_tips(const CadModel& model, const TetMesh& mesh, const Mat3& frame, const Monitor& monitor);

}  // namespace polycube
