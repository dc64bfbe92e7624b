#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include "estimation/block_cholesky_internal.h"

namespace rex::internal {
namespace {

// The column of each node in the order of approximate minimum degree.
std::vector<int> eliminationOrder(int nodes, const std::vector<std::pair<int, int>>& edges) {
  std::vector<Eigen::Triplet<signed char>> entries;
  entries.reserve(edges.size() + static_cast<std::size_t>(nodes));
  for (int i = 0; i < nodes; ++i) entries.emplace_back(i, i, 1);
  for (const auto& [a, b] : edges) entries.emplace_back(std::max(a, b), std::min(a, b), 1);
  Eigen::SparseMatrix<signed char> lower(nodes, nodes);
  lower.setFromTriplets(entries.begin(), entries.end());
  Eigen::AMDOrdering<int>::PermutationType order;
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order);
  std::vector<int> columns(static_cast<std::size_t>(nodes));
  for (int c = 0; c < nodes; ++c) columns[static_cast<std::size_t>(order.indices()[c])] = c;
  return columns;
}

}  // namespace

// A column has the rows of the matrix, and those of the columns whose first row below the diagonal it is.
BlockPattern::BlockPattern(int nodes, const std::vector<std::pair<int, int>>& edges)
    : columns_(eliminationOrder(nodes, edges)) {
  const auto count = static_cast<std::size_t>(nodes);
  std::vector<std::vector<int>> below(count), children(count);
  for (const auto& [a, b] : edges) {
    const auto [first, last] = std::minmax({column(a), column(b)});
    if (first != last) below[static_cast<std::size_t>(first)].push_back(last);
  }
  starts_.push_back(0);
  std::vector<int> lastSeenIn(count, -1);
  for (int c = 0; c < nodes; ++c) {
    const auto at = static_cast<std::size_t>(c);
    rows_.push_back(c);
    const auto first = static_cast<std::ptrdiff_t>(rows_.size());
    lastSeenIn[at] = c;
    const auto take = [&](int row) {
      if (std::exchange(lastSeenIn[static_cast<std::size_t>(row)], c) != c) rows_.push_back(row);
    };
    for (const int row : below[at]) take(row);
    for (const int child : children[at])
      for (int block = start(child) + 1; block < start(child + 1); ++block) take(row(block));
    std::sort(rows_.begin() + first, rows_.end());
    if (first < std::ssize(rows_))
      children[static_cast<std::size_t>(rows_[static_cast<std::size_t>(first)])].push_back(c);
    starts_.push_back(size());
  }
}

BlockPattern::Place BlockPattern::place(int a, int b) const {
  const auto [first, last] = std::minmax({column(a), column(b)});
  const auto begin = rows_.begin() + start(first), end = rows_.begin() + start(first + 1);
  const auto found = std::lower_bound(begin, end, last);
  assert(found != end && *found == last);
  return {static_cast<int>(found - rows_.begin()), column(a) < column(b)};
}

}  // namespace rex::internal
