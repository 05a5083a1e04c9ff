// CAD faces that may have to take two labels though they have one normal, or all but.
#pragma once

#include "label/divide.h"
#include "label/straighten.h"
#include "label/strips.h"

namespace polycube {

/// What the division of a part's faces goes by, per boundary triangle or CAD face.
struct FaceShapes {
  const CadModel& model;
  const TetMesh& mesh;
  const Mat3& frame;
  const std::vector<Vec3>& normal;   ///< per triangle, in the frame
  const std::vector<char>& whole;    ///< per CAD face: one label for all of it
  const std::vector<char>& flat;     ///< per CAD face: it hardly bends
  const std::vector<FaceCut>& cuts;  ///< per CAD face: how an oblique plane is divided, zero for the usual way
  const Tips* tips;                  ///< null: faces that end in a point are treated as others
  const Room* room;                  ///< null, or strips along barrels, which are not halved then

  bool has_tip(int face) const { return tips && !tips->axis[face].isZero(); }
};

/// An oblique plane is halved half way down its slope (the hypotenuse of a rib, a side of a pyramid), a bent face where its normal passes 45 degrees, a side
/// of an oblique barrel half way along it (the wedge that an oblique bore leaves beside a plane). The search decides whether the halves differ.
class Halves {
 public:
  /// `labels` per triangle: the sides of barrels. `shapes` must outlive the object.
  Halves(const FaceShapes& shapes, const std::vector<int>& labels);

  /// Below 8.
  int half(int triangle) const { return half_[triangle]; }
  /// Is the face cut across a slope of its own?
  bool sloping(int face) const { return !slope_[face].isZero(); }
  /// A barrel whose sides are halved across its axis.
  bool barrel(int face) const { return barrel_[face] > 0; }
  /// Positive in half `upper`, negative in the one below it, in a sloping face; `label` is the side of a barrel.
  std::function<double(int)> border(int face, int upper, int label) const;
  /// Positive in part `p`, negative in part `q` of a plane divided in thirds, beside their border.
  std::function<double(int)> third_border(int face, int p, int q) const;

 private:
  void find_barrels();
  void find_middles(const std::vector<int>& labels);
  void find_centres();
  double along(int face, int node) const;
  /// Of the cut below half `upper`.
  double middle(int face, int upper, int label) const;

  FaceShapes s_;
  std::vector<int> half_;                      // per triangle
  std::vector<int> barrel_;                    // per CAD face: the first of those that make up the same oblique barrel, else 0
  std::vector<Vec3> slope_;                    // per CAD face: direction across the cut, else zero
  std::vector<std::array<double, 6>> middle_;  // per CAD face: where it is cut along the slope, first and second; of a barrel, per label
  std::vector<Vec3> centre_;                   // per CAD face divided in thirds: where they meet, in the frame
};

}  // namespace polycube
