// Sparse Cholesky factorisation in dense blocks (multifrontal: Duff, Reid 1983; Liu 1992).
#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace polycube {

/// L L^T of a positive definite matrix. The same bits on every machine and thread; several may work at once, each on its own matrix.
class Cholesky {
 public:
  /// `matrix`: its lower triangle, square. False where the matrix is not positive definite; then there is nothing to solve with.
  bool factorise(const Eigen::SparseMatrix<double>& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs) const;

 private:
  /// Consecutive columns (in the order of elimination) that share one set of rows.
  struct Block {
    int first = 0, columns = 0;
    std::vector<int> rows;    // below the columns, ascending
    int parent = -1;
    Eigen::MatrixXd factor;   // columns + rows high: L of the columns, then of the rows
  };

  void analyse(const Eigen::SparseMatrix<double>& matrix);
  void merge_blocks();
  bool factorise_block(int b, std::vector<Eigen::MatrixXd>& update, std::vector<int>& place, const std::vector<std::vector<int>>& children);

  std::vector<int> position_;        // per unknown: its place in the order of elimination
  std::vector<std::vector<std::pair<int, double>>> columns_;  // per place: entries on and below the diagonal
  std::vector<Block> blocks_;        // children before parents
};

}  // namespace polycube
