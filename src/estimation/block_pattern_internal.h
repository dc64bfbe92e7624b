#pragma once

#include <utility>
#include <vector>

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

}  // namespace rex::internal
