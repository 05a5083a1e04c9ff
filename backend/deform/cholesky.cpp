#include "deform/cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <algorithm>
#include <numeric>

namespace polycube {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

// Share of zeros up to which two blocks are worth one dense block, by the columns that it has.
double bearable_zeros(int columns) { return columns <= 4 ? 1 : columns <= 16 ? 0.8 : columns <= 48 ? 0.1 : 0.05; }

std::vector<int> least_degree_order(const Matrix& lower) {
  Matrix full;
  full = lower.selfadjointView<Eigen::Lower>();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(full, order);
  std::vector<int> position(static_cast<std::size_t>(lower.cols()));
  for (Eigen::Index i = 0; i < lower.cols(); ++i) position[static_cast<std::size_t>(order.indices()[i])] = static_cast<int>(i);
  return position;
}

// Parent of every column in the elimination tree (Liu 1986); -1 for roots.
std::vector<int> elimination_tree(const Matrix& lower, const std::vector<int>& position) {
  const std::size_t n = position.size();
  std::vector<std::vector<int>> left(n);  // per row: the columns of its entries
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (Matrix::InnerIterator it(lower, j); it; ++it) {
      const auto [a, b] = std::minmax(position[static_cast<std::size_t>(it.row())], position[static_cast<std::size_t>(j)]);
      if (a != b) left[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  std::vector<int> parent(n, -1), ancestor(n, -1);
  for (int i = 0; i < static_cast<int>(n); ++i) {
    for (int j : left[i]) {
      while (j >= 0 && j < i) {
        const int next = ancestor[j];
        ancestor[j] = i;
        if (next < 0) parent[j] = i;
        j = next;
      }
    }
  }
  return parent;
}

std::vector<std::vector<int>> children_of(const std::vector<int>& parent) {
  std::vector<std::vector<int>> children(parent.size());
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) {
    if (parent[i] >= 0) children[parent[i]].push_back(i);
  }
  return children;
}

// Per node its place when children come right before their parents.
std::vector<int> postorder(const std::vector<int>& parent) {
  auto children = children_of(parent);
  std::vector<int> place(parent.size()), stack;
  int next = 0;
  for (int root = 0; root < static_cast<int>(parent.size()); ++root) {
    if (parent[root] >= 0) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const int at = stack.back();
      if (children[at].empty()) {
        place[at] = next++;
        stack.pop_back();
      } else {
        stack.push_back(children[at].back());
        children[at].pop_back();
      }
    }
  }
  return place;
}

}  // namespace

bool Cholesky::factorise(const Matrix& matrix) {
  analyse(matrix);
  std::vector<int> parent;
  for (const Block& b : blocks_) parent.push_back(b.parent);
  const auto children = children_of(parent);
  std::vector<Eigen::MatrixXd> update(blocks_.size());
  std::vector<int> place(position_.size());
  for (int b = 0; b < static_cast<int>(blocks_.size()); ++b) {
    if (!factorise_block(b, update, place, children)) return false;
  }
  columns_.clear();
  return true;
}

void Cholesky::analyse(const Matrix& matrix) {
  position_ = least_degree_order(matrix);
  std::vector<int> parent = elimination_tree(matrix, position_);
  const std::vector<int> place = postorder(parent);
  for (int& p : position_) p = place[p];
  std::vector<int> moved(parent.size());
  for (std::size_t i = 0; i < parent.size(); ++i) moved[place[i]] = parent[i] < 0 ? -1 : place[parent[i]];
  parent = std::move(moved);

  const int n = static_cast<int>(parent.size());
  columns_.assign(parent.size(), {});
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    for (Matrix::InnerIterator it(matrix, j); it; ++it) {
      const auto [a, b] = std::minmax(position_[static_cast<std::size_t>(it.row())], position_[static_cast<std::size_t>(j)]);
      columns_[a].emplace_back(b, it.value());
    }
  }
  // Rows of every column of L: its own entries and those of its children in the tree.
  std::vector<std::vector<int>> rows(parent.size());
  std::vector<int> seen(parent.size(), -1);
  const auto children = children_of(parent);
  blocks_.clear();
  std::vector<int> block_of(parent.size());
  for (int j = 0; j < n; ++j) {
    seen[j] = j;
    const auto add = [&](int i) {
      if (seen[i] == j) return;
      seen[i] = j;
      rows[j].push_back(i);
    };
    for (const auto& [i, value] : columns_[j]) add(i);
    for (int c : children[j]) {
      for (int i : rows[c]) add(i);
    }
    const bool goes_on = j > 0 && parent[j - 1] == j && rows[j - 1].size() == rows[j].size() + 1;
    for (int c : children[j]) rows[c] = {};
    if (!goes_on) blocks_.push_back({j, 0, {}, -1, {}});
    Block& block = blocks_.back();
    ++block.columns;
    block.rows = rows[j];
    block_of[j] = static_cast<int>(blocks_.size()) - 1;
  }
  for (Block& b : blocks_) {
    std::sort(b.rows.begin(), b.rows.end());
    b.parent = b.rows.empty() ? -1 : block_of[b.rows.front()];
  }
  merge_blocks();
}

// A block takes in the child that ends where it begins, if that stores few zeros.
void Cholesky::merge_blocks() {
  std::vector<Block> merged;
  std::vector<int> now(blocks_.size());  // per old block
  std::vector<double> zeros;             // per new block
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Block block = std::move(blocks_[b]);
    double empty = 0;
    while (!merged.empty()) {
      const Block& last = merged.back();
      const bool child = !last.rows.empty() && last.rows.front() >= block.first && last.rows.front() < block.first + block.columns;
      if (!child) break;
      const double height = static_cast<double>(block.columns) + static_cast<double>(block.rows.size());
      const double more = empty + zeros.back() + last.columns * (height - static_cast<double>(last.rows.size()));
      const int columns = last.columns + block.columns;
      const double size = columns * (columns + 1) / 2.0 + columns * static_cast<double>(block.rows.size());
      if (more > bearable_zeros(columns) * size) break;
      block.first = last.first;
      block.columns = columns;
      empty = more;
      merged.pop_back();
      zeros.pop_back();
    }
    merged.push_back(std::move(block));
    zeros.push_back(empty);
  }
  std::vector<int> block_of(position_.size());
  for (std::size_t b = 0; b < merged.size(); ++b) {
    for (int c = 0; c < merged[b].columns; ++c) block_of[merged[b].first + c] = static_cast<int>(b);
  }
  for (Block& b : merged) b.parent = b.rows.empty() ? -1 : block_of[b.rows.front()];
  blocks_ = std::move(merged);
}

// `update`: what a block leaves for the rows below it; `place`: scratch.
bool Cholesky::factorise_block(int b, std::vector<Eigen::MatrixXd>& update, std::vector<int>& place, const std::vector<std::vector<int>>& children) {
  Block& block = blocks_[b];
  const int k = block.columns, m = static_cast<int>(block.rows.size());
  for (int c = 0; c < k; ++c) place[block.first + c] = c;
  for (int r = 0; r < m; ++r) place[block.rows[r]] = k + r;
  Eigen::MatrixXd& l = block.factor;
  Eigen::MatrixXd& u = update[b];
  l.setZero(k + m, k);
  u.setZero(m, m);
  for (int c = 0; c < k; ++c) {
    for (const auto& [i, value] : columns_[block.first + c]) l(place[i], c) += value;
  }
  for (int child : children[b]) {
    const std::vector<int>& rows = blocks_[child].rows;
    const Eigen::MatrixXd& from = update[child];
    for (std::size_t j = 0; j < rows.size(); ++j) {
      const int column = place[rows[j]];
      for (std::size_t i = j; i < rows.size(); ++i) {
        const double value = from(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (column < k) {
          l(place[rows[i]], column) += value;
        } else {
          u(place[rows[i]] - k, column - k) += value;
        }
      }
    }
    update[child].resize(0, 0);
  }
  auto square = l.topRows(k);
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> dense(square);
  if (dense.info() != Eigen::Success) return false;
  if (m == 0) return true;
  auto below = l.bottomRows(m);
  square.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
  u.selfadjointView<Eigen::Lower>().rankUpdate(below, -1);
  return true;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& rhs) const {
  Eigen::VectorXd x(rhs.size()), part;
  for (Eigen::Index i = 0; i < rhs.size(); ++i) x[position_[static_cast<std::size_t>(i)]] = rhs[i];
  for (const Block& b : blocks_) {
    auto own = x.segment(b.first, b.columns);
    b.factor.topRows(b.columns).triangularView<Eigen::Lower>().solveInPlace(own);
    part.noalias() = b.factor.bottomRows(b.factor.rows() - b.columns) * own;
    for (std::size_t r = 0; r < b.rows.size(); ++r) x[b.rows[r]] -= part[static_cast<Eigen::Index>(r)];
  }
  for (std::size_t i = blocks_.size(); i-- > 0;) {
    const Block& b = blocks_[i];
    part.resize(static_cast<Eigen::Index>(b.rows.size()));
    for (std::size_t r = 0; r < b.rows.size(); ++r) part[static_cast<Eigen::Index>(r)] = x[b.rows[r]];
    auto own = x.segment(b.first, b.columns);
    own.noalias() -= b.factor.bottomRows(part.size()).transpose() * part;
    b.factor.topRows(b.columns).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  Eigen::VectorXd result(rhs.size());
  for (Eigen::Index i = 0; i < rhs.size(); ++i) result[i] = x[position_[static_cast<std::size_t>(i)]];
  return result;
}

}  // namespace polycube
