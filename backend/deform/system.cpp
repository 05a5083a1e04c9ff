#include "deform/system.h"

#include <Eigen/LU>

#include "deform/tuning.h"

namespace polycube {

Element make_element(const std::vector<Vec3>& points, const Tet& tet) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = points[tet[k + 1]] - points[tet[0]];
  const Mat3 inverse = edges.inverse();
  Element e;
  for (int k = 0; k < 3; ++k) e.gradient.col(k + 1) = inverse.row(k).transpose();
  e.gradient.col(0) = -e.gradient.rightCols<3>().rowwise().sum();
  e.volume = edges.determinant() / 6;
  return e;
}

Mat3 jacobian(const Tet& tet, const Element& element, const std::vector<Vec3>& image) {
  Mat3 j = Mat3::Zero();
  for (int a = 0; a < 4; ++a) j += image[tet[a]] * element.gradient.col(a).transpose();
  return j;
}

Coordinate::Coordinate(const TetMesh& mesh, const std::vector<Element>& elements, UnionFind groups) : unknown_(mesh.points.size(), -1) {
  const int n = static_cast<int>(mesh.points.size());
  for (int i = 0; i < n; ++i) {
    if (groups.find(i) == i) unknown_[i] = count_++;
  }
  for (int i = 0; i < n; ++i) unknown_[i] = unknown_[groups.find(i)];
  if (count_ < 2) return;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(elements.size() * 16);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const Eigen::Matrix4d k = elements[t].volume * elements[t].gradient.transpose() * elements[t].gradient;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const int i = unknown_[mesh.tets[t][a]], j = unknown_[mesh.tets[t][b]];
        if (i > 0 && j > 0) entries.emplace_back(i - 1, j - 1, k(a, b));
      }
    }
  }
  matrix_.resize(count_ - 1, count_ - 1);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  solver_.setTolerance(kDeformTuning.residual);
  solver_.setMaxIterations(kDeformTuning.most_steps);
  solver_.compute(matrix_);
  ok_ = solver_.info() == Eigen::Success;
}

Vector Coordinate::solve(const TetMesh& mesh, const std::vector<Element>& elements, const std::vector<Mat3>& target, int row, const Vector& guess) const {
  Vector rhs = Vector::Zero(count_), start(count_);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    const Eigen::Vector4d b = elements[t].volume * elements[t].gradient.transpose() * target[t].row(row).transpose();
    for (int a = 0; a < 4; ++a) rhs[unknown_[mesh.tets[t][a]]] += b[a];
  }
  for (std::size_t i = 0; i < unknown_.size(); ++i) start[unknown_[i]] = guess[static_cast<Eigen::Index>(i)];
  Vector x(count_);
  x[0] = 0;
  x.tail(count_ - 1) = solver_.solveWithGuess(rhs.tail(count_ - 1), (start.tail(count_ - 1).array() - start[0]).matrix());
  Vector result(static_cast<Eigen::Index>(unknown_.size()));
  for (std::size_t i = 0; i < unknown_.size(); ++i) result[static_cast<Eigen::Index>(i)] = x[unknown_[i]];
  return result;
}

Vector Coordinate::precondition(const Vector& rhs) const {
  Vector x(count_);
  x[0] = 0;
  x.tail(count_ - 1) = solver_.preconditioner().solve(rhs.tail(count_ - 1));
  return x;
}

}  // namespace polycube
