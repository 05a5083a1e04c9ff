// The linear systems of the map: one per coordinate, nodes of a chart sharing one unknown.
#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <memory>

#include "core/mesh.h"
#include "core/union_find.h"
#include "deform/multigrid.h"

namespace polycube {

/// Gradients of the four hat functions of a tet (columns, 1/mm) and its volume (mm^3).
struct Element {
  Eigen::Matrix<double, 3, 4> gradient;
  double volume;
};

Element make_element(const std::vector<Vec3>& points, const Tet& tet);

/// Jacobian of the map that takes the tet's points to their images.
Mat3 jacobian(const Tet& tet, const Element& element, const std::vector<Vec3>& image);

/// One coordinate: least squares of gradients. Unknown 0 is held at zero, since a coordinate is known up to a constant only.
class Coordinate {
 public:
  Coordinate(const TetMesh& mesh, const std::vector<Element>& elements, UnionFind groups);

  bool ok() const { return ok_; }
  int unknowns() const { return count_; }
  int unknown(int node) const { return unknown_[node]; }
  /// `target`: per tet the wished gradient of the map, whose `row` is this coordinate's. Takes and returns one value per node; begins at `guess`.
  Vector solve(const TetMesh& mesh, const std::vector<Element>& elements, const std::vector<Mat3>& target, int row, const Vector& guess) const;
  /// Near the inverse of the system times a right side with one entry per unknown (entry 0 is ignored and comes back 0). Linear, symmetric, positive.
  Vector precondition(const Vector& rhs) const;

 private:
  std::vector<int> unknown_;
  int count_ = 0;
  bool ok_ = false;
  SparseRows matrix_;  // without unknown 0
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper, Multigrid> solver_;
};

}  // namespace polycube
