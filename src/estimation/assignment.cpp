#include "estimation/assignment.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

constexpr int kFree = -1;

void requireCosts(const Eigen::MatrixXd& cost) {
  if (cost.rows() > cost.cols())
    throw Error({.what = "costs of an assignment",
                 .found = fmt::format("{} rows and {} columns", cost.rows(), cost.cols()),
                 .wanted = "at least as many columns as rows"});
  for (Eigen::Index j = 0; j < cost.cols(); ++j)
    for (Eigen::Index i = 0; i < cost.rows(); ++i)
      if (!std::isfinite(cost(i, j)))
        throw Error({.what = fmt::format("cost of row {} and column {}", i, j),
                     .found = fmt::format("{:g}", cost(i, j)),
                     .wanted = "a finite number"});
}

}  // namespace

std::vector<int> cheapestAssignment(const Eigen::MatrixXd& cost) {
  requireCosts(cost);
  const Eigen::Index columns = cost.cols();
  Eigen::VectorXd ofRow = Eigen::VectorXd::Zero(cost.rows()), ofColumn = Eigen::VectorXd::Zero(columns);
  std::vector<int> rowOf(static_cast<std::size_t>(columns), kFree);
  const auto row = [&](Eigen::Index column) -> int& { return rowOf[static_cast<std::size_t>(column)]; };
  for (int first = 0; first < cost.rows(); ++first) {
    // Dijkstra over reduced costs, which are never negative, from a new row to the nearest free column.
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(columns, std::numeric_limits<double>::infinity());
    std::vector<Eigen::Index> from(static_cast<std::size_t>(columns), kFree);
    std::vector<bool> isDone(static_cast<std::size_t>(columns), false);
    Eigen::Index last = kFree;
    double reached = 0;
    for (int i = first; i != kFree; i = row(last)) {
      Eigen::Index nearest = kFree;
      for (Eigen::Index j = 0; j < columns; ++j) {
        if (isDone[static_cast<std::size_t>(j)]) continue;
        const double through = reached + cost(i, j) - ofRow[i] - ofColumn[j];
        if (through < distance[j]) {
          distance[j] = through;
          from[static_cast<std::size_t>(j)] = last;
        }
        if (nearest == kFree || distance[j] < distance[nearest]) nearest = j;
      }
      last = nearest;
      reached = distance[last];
      isDone[static_cast<std::size_t>(last)] = true;
    }
    ofRow[first] += reached;
    for (Eigen::Index j = 0; j < columns; ++j) {
      if (!isDone[static_cast<std::size_t>(j)] || j == last) continue;
      ofColumn[j] -= reached - distance[j];
      ofRow[row(j)] += reached - distance[j];
    }
    while (last != kFree) {  // each column of the path takes the row of the one before
      const Eigen::Index before = from[static_cast<std::size_t>(last)];
      row(last) = before == kFree ? first : row(before);
      last = before;
    }
  }
  std::vector<int> columnOf(static_cast<std::size_t>(cost.rows()));
  for (Eigen::Index j = 0; j < columns; ++j)
    if (row(j) != kFree) columnOf[static_cast<std::size_t>(row(j))] = static_cast<int>(j);
  return columnOf;
}

}  // namespace rex
