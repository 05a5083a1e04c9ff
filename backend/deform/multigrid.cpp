#include "deform/multigrid.h"

#include <algorithm>
#include <cmath>

#include "deform/tuning.h"

namespace polycube {
namespace {

// Of the matrix divided by its diagonal.
double largest_eigenvalue(const SparseRows& matrix, const Vector& diagonal) {
  Vector x(matrix.rows());
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = 1 + static_cast<double>((i * 7919) % 97) / 97 * (i % 2 == 0 ? 1 : -3);
  double value = 1;
  for (int step = 0; step < kDeformTuning.power_steps; ++step) {
    x /= x.norm();
    x = (matrix * x).cwiseQuotient(diagonal);
    value = x.norm();
  }
  return kDeformTuning.power_margin * value;
}

void smooth_forward(const SparseRows& a, const Vector& diagonal, const Vector& rhs, Vector& x) {
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    double sum = rhs[i] + diagonal[i] * x[i];
    for (SparseRows::InnerIterator it(a, i); it; ++it) sum -= it.value() * x[it.col()];
    x[i] = sum / diagonal[i];
  }
}

void smooth_backward(const SparseRows& a, const Vector& diagonal, const Vector& rhs, Vector& x) {
  for (Eigen::Index i = a.rows(); i-- > 0;) {
    double sum = rhs[i] + diagonal[i] * x[i];
    for (SparseRows::InnerIterator it(a, i); it; ++it) sum -= it.value() * x[it.col()];
    x[i] = sum / diagonal[i];
  }
}

}  // namespace

std::vector<int> aggregate(const SparseRows& matrix) {
  const Eigen::Index n = matrix.rows();
  const Vector diagonal = matrix.diagonal();
  const auto dense = [&](Eigen::Index i) {
    const Eigen::Index entries = matrix.outerIndexPtr()[i + 1] - matrix.outerIndexPtr()[i];
    return entries * n > kDeformTuning.dense * matrix.nonZeros();
  };
  const auto near = [&](Eigen::Index i, const auto& visit) {
    for (SparseRows::InnerIterator it(matrix, i); it; ++it) {
      if (it.col() != i && !dense(it.col()) && std::abs(it.value()) > kDeformTuning.weak * std::sqrt(diagonal[i] * diagonal[it.col()]))
        visit(it.col(), std::abs(it.value()));
    }
  };
  std::vector<int> group(static_cast<std::size_t>(n), -1);
  int count = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (dense(i)) group[i] = count++;
  }
  // An unknown with all its neighbours, where none of them has a group yet.
  for (Eigen::Index i = 0; i < n; ++i) {
    bool free = group[i] < 0;
    near(i, [&](Eigen::Index j, double) { free = free && group[j] < 0; });
    if (!free) continue;
    group[i] = count;
    near(i, [&](Eigen::Index j, double) { group[j] = count; });
    ++count;
  }
  // The others join the group of the neighbour that they hang on most.
  const std::vector<int> first = group;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (group[i] >= 0) continue;
    double most = 0;
    near(i, [&](Eigen::Index j, double value) {
      if (first[j] >= 0 && value > most) {
        most = value;
        group[i] = first[j];
      }
    });
    if (group[i] < 0) group[i] = count++;
  }
  return group;
}

Multigrid& Multigrid::compute(SparseRows matrix) {
  levels_.clear();
  while (matrix.rows() > kDeformTuning.coarsest) {
    const std::vector<int> group = aggregate(matrix);
    const int count = *std::max_element(group.begin(), group.end()) + 1;
    if (count > kDeformTuning.least_gain * static_cast<double>(matrix.rows())) break;
    Level& level = levels_.emplace_back();
    level.matrix.swap(matrix);
    level.diagonal = level.matrix.diagonal();
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) entries.emplace_back(static_cast<int>(i), group[i], 1.0);
    SparseRows tentative(level.matrix.rows(), count);
    tentative.setFromTriplets(entries.begin(), entries.end());
    const double damping = 4.0 / 3 / largest_eigenvalue(level.matrix, level.diagonal);
    SparseRows change = level.matrix * tentative;
    change = (damping * level.diagonal.cwiseInverse()).asDiagonal() * change;
    level.prolongation = tentative - change;
    level.restriction = level.prolongation.transpose();
    matrix = level.restriction * SparseRows(level.matrix * level.prolongation);
  }
  coarsest_.compute(Eigen::SparseMatrix<double>(matrix));
  info_ = coarsest_.info();
  return *this;
}

Vector Multigrid::cycle(std::size_t at, const Vector& rhs) const {
  if (at == levels_.size()) return coarsest_.solve(rhs);
  const Level& level = levels_[at];
  Vector x = Vector::Zero(rhs.size());
  smooth_forward(level.matrix, level.diagonal, rhs, x);
  const Vector left = rhs - level.matrix * x;
  x += level.prolongation * cycle(at + 1, level.restriction * left);
  smooth_backward(level.matrix, level.diagonal, rhs, x);
  return x;
}

}  // namespace polycube
