#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace rex::internal {

/// Where the Cholesky factor of a symmetric matrix of blocks has blocks, when its nodes are eliminated in an
/// order that fills few: by columns in that order, first the block on the diagonal, then those below, by
/// rows. One pattern serves blocks of any size, so it is made once per graph. Davis, Direct Methods for
/// Sparse Linear Systems, 2006.
class BlockPattern {
 public:
  /// `edges` join nodes 0 .. nodes - 1; repeated ones and those that join a node with itself are allowed.
  BlockPattern(int nodes, const std::vector<std::pair<int, int>>& edges);

  int nodes() const { return static_cast<int>(starts_.size()) - 1; }
  /// How many blocks the factor has.
  int size() const { return static_cast<int>(rows_.size()); }
  /// When node i is eliminated: its column.
  int column(int node) const { return columns_[static_cast<std::size_t>(node)]; }
  /// The blocks start(c) to start(c + 1) - 1 belong to column c; the row of each, in the same order.
  int start(int column) const { return starts_[static_cast<std::size_t>(column)]; }
  int row(int block) const { return rows_[static_cast<std::size_t>(block)]; }

  /// The block of two nodes that an edge joins, or of one node twice.
  struct Place {
    int block = 0;
    bool isTransposed = false;  ///< it is that of (b, a)
  };
  [[nodiscard]] Place place(int a, int b) const;

 private:
  std::vector<int> columns_, starts_, rows_;
};

/// A symmetric matrix of blocks of one size, and its Cholesky factor, column by column: each takes what the
/// columns before it, listed by their next row, subtract from it.
template <int N>
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;

  explicit BlockCholesky(std::shared_ptr<const BlockPattern> pattern)
      : pattern_(std::move(pattern)), H_(static_cast<std::size_t>(pattern_->size()), Block::Zero()) {}

  const BlockPattern& pattern() const { return *pattern_; }
  void setZero() { std::fill(H_.begin(), H_.end(), Block::Zero()); }
  /// Adds to the block of (a, b), which is also that of (b, a), transposed; `place` is that of the pattern. A
  /// block on the diagonal is symmetric.
  void add(BlockPattern::Place place, const Block& block) {
    at(H_, place.block) += place.isTransposed ? Block(block.transpose()) : block;
  }
  void add(int a, int b, const Block& block) { add(pattern_->place(a, b), block); }
  Block& diagonal(int node) { return at(H_, pattern_->start(pattern_->column(node))); }
  const Block& diagonal(int node) const { return at(H_, pattern_->start(pattern_->column(node))); }

  /// The product with x, a row of whose blocks belongs to each node.
  [[nodiscard]] Eigen::MatrixXd times(const Eigen::MatrixXd& x) const {
    const Eigen::MatrixXd mine = permuted(x, true);
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(x.rows(), x.cols());
    for (int c = 0; c < pattern_->nodes(); ++c) {
      const int start = pattern_->start(c);
      product.middleRows<N>(N * c) += at(H_, start) * mine.middleRows<N>(N * c);
      for (int block = start + 1; block < pattern_->start(c + 1); ++block) {
        const int row = pattern_->row(block);
        product.middleRows<N>(N * row) += at(H_, block) * mine.middleRows<N>(N * c);
        product.middleRows<N>(N * c) += at(H_, block).transpose() * mine.middleRows<N>(N * row);
      }
    }
    return permuted(product, false);
  }

  /// Factors the matrix + shift * identity; false if that is not positive definite.
  [[nodiscard]] bool factorize(double shift) {
    const int nodes = pattern_->nodes();
    const auto count = static_cast<std::size_t>(nodes);
    L_ = H_;
    std::vector<int> first(count, -1), next(count, -1), blockAt(count), target(count);
    const auto list = [&](int column, int block) {
      if (block == pattern_->start(column + 1)) return;
      const auto row = static_cast<std::size_t>(pattern_->row(block));
      blockAt[static_cast<std::size_t>(column)] = block;
      next[static_cast<std::size_t>(column)] = first[row];
      first[row] = column;
    };
    for (int c = 0; c < nodes; ++c) {
      const int start = pattern_->start(c), end = pattern_->start(c + 1);
      for (int block = start; block < end; ++block)
        target[static_cast<std::size_t>(pattern_->row(block))] = block;
      for (int before = first[static_cast<std::size_t>(c)], following = -1; before >= 0; before = following) {
        following = next[static_cast<std::size_t>(before)];
        const int mine = blockAt[static_cast<std::size_t>(before)];
        const Block& B = at(L_, mine);
        for (int block = mine; block < pattern_->start(before + 1); ++block)
          subtractProduct(at(L_, block), B, at(L_, target[static_cast<std::size_t>(pattern_->row(block))]));
        list(before, mine + 1);
      }
      at(L_, start).diagonal().array() += shift;
      if (!factorDiagonal(at(L_, start))) return false;
      for (int block = start + 1; block < end; ++block) divide(at(L_, block), at(L_, start));
      list(c, start + 1);
    }
    return true;
  }

  /// Solves with the last factor, which must be one. A row of blocks belongs to each node.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& rhs) const {
    Eigen::MatrixXd x = permuted(rhs, true);
    for (Eigen::Index column = 0; column < x.cols(); ++column) solve(x.col(column).data());
    return permuted(x, false);
  }

 private:
  static Block& at(std::vector<Block>& blocks, int i) { return blocks[static_cast<std::size_t>(i)]; }
  static const Block& at(const std::vector<Block>& blocks, int i) {
    return blocks[static_cast<std::size_t>(i)];
  }

  // C -= A B^T.
  static void subtractProduct(const Block& A, const Block& B, Block& C) {
    for (int c = 0; c < N; ++c)
      for (int k = 0; k < N; ++k)
        for (int r = 0; r < N; ++r) C(r, c) -= A(r, k) * B(c, k);
  }
  // The lower triangle becomes that of the factor.
  static bool factorDiagonal(Block& D) {
    for (int c = 0; c < N; ++c) {
      for (int k = 0; k < c; ++k)
        for (int r = c; r < N; ++r) D(r, c) -= D(r, k) * D(c, k);
      if (!(D(c, c) > 0)) return false;
      D(c, c) = std::sqrt(D(c, c));
      for (int r = c + 1; r < N; ++r) D(r, c) /= D(c, c);
    }
    return true;
  }
  // A becomes A D^-T.
  static void divide(Block& A, const Block& D) {
    for (int c = 0; c < N; ++c) {
      for (int k = 0; k < c; ++k)
        for (int r = 0; r < N; ++r) A(r, c) -= A(r, k) * D(c, k);
      for (int r = 0; r < N; ++r) A(r, c) /= D(c, c);
    }
  }
  void solve(double* x) const {
    const auto part = [&](int row) { return Eigen::Map<Vector>(x + N * row); };
    for (int c = 0; c < pattern_->nodes(); ++c) {
      const int start = pattern_->start(c);
      at(L_, start).template triangularView<Eigen::Lower>().solveInPlace(part(c));
      for (int block = start + 1; block < pattern_->start(c + 1); ++block)
        part(pattern_->row(block)) -= at(L_, block) * part(c);
    }
    for (int c = pattern_->nodes() - 1; c >= 0; --c) {
      const int start = pattern_->start(c);
      for (int block = start + 1; block < pattern_->start(c + 1); ++block)
        part(c) -= at(L_, block).transpose() * part(pattern_->row(block));
      at(L_, start).transpose().template triangularView<Eigen::Upper>().solveInPlace(part(c));
    }
  }
  // From the order of nodes into that of columns, or back.
  Eigen::MatrixXd permuted(const Eigen::MatrixXd& x, bool toColumns) const {
    Eigen::MatrixXd result(x.rows(), x.cols());
    for (int i = 0; i < pattern_->nodes(); ++i) {
      const int column = pattern_->column(i), from = toColumns ? i : column, to = toColumns ? column : i;
      result.middleRows<N>(N * to) = x.middleRows<N>(N * from);
    }
    return result;
  }

  std::shared_ptr<const BlockPattern> pattern_;
  std::vector<Block> H_, L_;
};

}  // namespace rex::internal
