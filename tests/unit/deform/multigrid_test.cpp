#include "deform/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <set>

namespace polycube {
namespace {

// Seven-point Laplacian of a cube of n x n x n nodes with its first node held. Where `chart`, all nodes of the last layer are one unknown.
SparseRows laplacian(int n, bool chart) {
  const auto unknown = [&](int i, int j, int k) { return (chart && k == n - 1 ? n * n * (n - 1) : i + n * (j + n * k)) - 1; };
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b) {
    if (a == b) return;
    for (const auto& [i, j, value] : {std::tuple(a, a, 1.0), std::tuple(b, b, 1.0), std::tuple(a, b, -1.0), std::tuple(b, a, -1.0)}) {
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, value);
    }
  };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        if (i + 1 < n) join(unknown(i, j, k), unknown(i + 1, j, k));
        if (j + 1 < n) join(unknown(i, j, k), unknown(i, j + 1, k));
        if (k + 1 < n) join(unknown(i, j, k), unknown(i, j, k + 1));
      }
    }
  }
  const int count = chart ? n * n * (n - 1) : n * n * n - 1;
  SparseRows matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

int steps_to_solve(const SparseRows& matrix) {
  Eigen::ConjugateGradient<SparseRows, Eigen::Lower | Eigen::Upper, Multigrid> solver;
  solver.setTolerance(1e-8);
  solver.compute(matrix);
  Vector wanted(matrix.rows());
  for (Eigen::Index i = 0; i < wanted.size(); ++i) wanted[i] = std::sin(0.37 * static_cast<double>(i)) + 0.001 * static_cast<double>(i);
  const Vector found = solver.solve(matrix * wanted);
  EXPECT_EQ(solver.info(), Eigen::Success);
  EXPECT_LT((found - wanted).norm(), 1e-4 * wanted.norm());
  return static_cast<int>(solver.iterations());
}

TEST(Multigrid, StepsHardlyGrowWithTheSize) {
  for (const bool chart : {false, true}) {
    const int small = steps_to_solve(laplacian(10, chart)), large = steps_to_solve(laplacian(30, chart));
    EXPECT_LE(small, 15);
    EXPECT_LE(large, small + 8) << "27 times the unknowns, chart " << chart;
  }
}

TEST(Multigrid, ACycleIsSymmetricAndPositive) {
  const SparseRows matrix = laplacian(10, true);
  const Multigrid cycle(matrix);
  const Eigen::Index n = matrix.rows();
  Eigen::MatrixXd dense(n, n);
  for (Eigen::Index i = 0; i < n; ++i) dense.col(i) = cycle.solve(Vector::Unit(n, i));
  EXPECT_LT((dense - dense.transpose()).cwiseAbs().maxCoeff(), 1e-12 * dense.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd symmetric = 0.5 * (dense + dense.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues().minCoeff(), 0);
}

TEST(Multigrid, EveryUnknownIsInOneGroupAndAChartAlone) {
  const SparseRows matrix = laplacian(12, true);
  const std::vector<int> group = aggregate(matrix);
  ASSERT_EQ(group.size(), static_cast<std::size_t>(matrix.rows()));
  const std::set<int> numbers(group.begin(), group.end());
  EXPECT_EQ(*numbers.begin(), 0);
  EXPECT_EQ(*numbers.rbegin() + 1, static_cast<int>(numbers.size()));
  EXPECT_LT(static_cast<double>(numbers.size()), 0.3 * static_cast<double>(matrix.rows()));
  EXPECT_EQ(std::count(group.begin(), group.end(), group.back()), 1);
}

TEST(Multigrid, FewUnknownsAreSolvedExactly) {
  const SparseRows matrix = laplacian(4, false);
  const Vector wanted = Vector::LinSpaced(matrix.rows(), -1, 2);
  EXPECT_LT((Multigrid(matrix).solve(matrix * wanted) - wanted).norm(), 1e-12);
}

}  // namespace
}  // namespace polycube
