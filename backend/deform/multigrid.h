// Multigrid by smoothed aggregation (Vanek, Mandel, Brezina 1996) as a preconditioner for Eigen's conjugate gradients.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

namespace polycube {

using Vector = Eigen::VectorXd;
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// One V-cycle: a fixed, symmetric, positive definite operator near the inverse of the matrix, at a cost in proportion to its entries. Has the interface of
/// Eigen's preconditioners. The matrix has both triangles filled.
class Multigrid {
 public:
  Multigrid() = default;
  explicit Multigrid(const SparseRows& matrix) { compute(matrix); }
  Multigrid(const Multigrid&) = delete;
  Multigrid& operator=(const Multigrid&) = delete;

  Multigrid& compute(SparseRows matrix);
  Vector solve(const Vector& rhs) const { return cycle(0, rhs); }
  Eigen::ComputationInfo info() const { return info_; }

 private:
  struct Level {
    SparseRows matrix;
    Vector diagonal;
    SparseRows prolongation;  ///< from the next level to this one
    SparseRows restriction;   ///< its transpose
  };
  Vector cycle(std::size_t level, const Vector& rhs) const;

  std::vector<Level> levels_;  ///< finest first
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
  Eigen::ComputationInfo info_ = Eigen::InvalidInput;
};

/// Groups of unknowns that hang together closely, numbered from 0; one number per row.
std::vector<int> aggregate(const SparseRows& matrix);

}  // namespace polycube
