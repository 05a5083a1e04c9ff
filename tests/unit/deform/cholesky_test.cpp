#include "deform/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace polycube {
namespace {

// The Laplacian of a box of n^3 points with one point held, and one more unknown that is tied to a whole side, as charts are.
Eigen::SparseMatrix<double> box_matrix(int n) {
  const int size = n * n * n + 1;
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}};
  const auto link = [&](int a, int b) {
    entries.insert(entries.end(), {{a, a, 1.0}, {b, b, 1.0}, {std::max(a, b), std::min(a, b), -1.0}});
  };
  for (int i = 0; i < n * n * n; ++i) {
    if (i % n + 1 < n) link(i, i + 1);
    if (i / n % n + 1 < n) link(i, i + n);
    if (i / (n * n) + 1 < n) link(i, i + n * n);
    if (i / (n * n) == 0) link(i, size - 1);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(Cholesky, SolvesWhatADenseFactorisationSolves) {
  for (int n : {1, 2, 3, 8}) {
    const Eigen::SparseMatrix<double> lower = box_matrix(n);
    const Eigen::MatrixXd dense = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
    Eigen::VectorXd rhs(lower.rows());
    for (Eigen::Index i = 0; i < rhs.size(); ++i) rhs[i] = static_cast<double>((7 * i) % 11) - 5;
    Cholesky cholesky;
    ASSERT_TRUE(cholesky.factorise(lower));
    EXPECT_LT((dense * cholesky.solve(rhs) - rhs).norm(), 1e-10 * rhs.norm()) << n;
    EXPECT_LT((cholesky.solve(rhs) - dense.llt().solve(rhs)).norm(), 1e-9 * rhs.norm()) << n;
  }
}

TEST(Cholesky, PartsThatDoNotTouchAreSolvedEach) {
  Eigen::SparseMatrix<double> lower(4, 4);
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, 2.0}, {2, 0, 1.0}, {2, 2, 3.0}, {1, 1, 4.0}, {3, 3, 5.0}};
  lower.setFromTriplets(entries.begin(), entries.end());
  Cholesky cholesky;
  ASSERT_TRUE(cholesky.factorise(lower));
  const Eigen::VectorXd x = cholesky.solve(Eigen::Vector4d(3, 4, 4, 5));
  EXPECT_LT((x - Eigen::Vector4d(1, 1, 1, 1)).norm(), 1e-14);
}

TEST(Cholesky, AMatrixThatIsNotPositiveDefiniteIsRefused) {
  Eigen::SparseMatrix<double> lower(2, 2);
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}};
  lower.setFromTriplets(entries.begin(), entries.end());
  EXPECT_FALSE(Cholesky().factorise(lower));
}

}  // namespace
}  // namespace polycube
