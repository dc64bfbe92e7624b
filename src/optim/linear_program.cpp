#include "optim/linear_program.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kZero = 1e-10;
constexpr double kFeasible = 1e-9;  // what may be missing of b, relative to its largest number

VectorXd largestOf(const MatrixXd& rows) {
  const VectorXd largest = rows.cwiseAbs().rowwise().maxCoeff();
  return (largest.array() > 0).select(largest, 1);
}

// The program with rows, columns, b and c scaled to size one. Its n columns are followed by m artificial
// ones, which b starts from.
class Simplex {
 public:
  Simplex(const MatrixXd& A, const VectorXd& b)
      : m_(A.rows()), n_(A.cols()), columns_(m_, n_ + m_), b_(b), basis_(static_cast<std::size_t>(m_)) {
    const VectorXd sign = (b.array() < 0).select(VectorXd::Constant(m_, -1), VectorXd::Ones(m_));
    columns_ << A, MatrixXd(sign.asDiagonal());
    for (Index i = 0; i < m_; ++i) at(i) = n_ + i;
  }

  // Minimises cost.x; false if that stalls. Only the first `allowed` columns enter the basis.
  bool minimize(const VectorXd& cost, Index allowed) {
    int flatSteps = 0;
    for (const Index most = iterations_ + 1000 + 50 * (m_ + n_); iterations_ < most; ++iterations_) {
      factor(cost);
      // Bland's rule ends the cycles that the steepest choice may run into.
      entering_ = enteringColumn(cost, allowed, flatSteps > 2 * m_);
      if (entering_ < 0) return true;
      step_ = lu_.solve(columns_.col(entering_));
      const Index row = leavingRow(flatSteps > 2 * m_);
      if (row < 0) return true;
      flatSteps = xB_[row] > kZero ? 0 : flatSteps + 1;
      at(row) = entering_;
    }
    return false;
  }

  bool isUnbounded() const { return entering_ >= 0; }
  int iterations() const { return static_cast<int>(iterations_); }
  const VectorXd& y() const { return y_; }

  double infeasibility() const {
    double sum = 0;
    for (Index i = 0; i < m_; ++i) sum += at(i) < n_ ? 0 : std::abs(xB_[i]);
    return sum;
  }
  VectorXd x() const { return spread(xB_); }
  VectorXd ray() const {
    VectorXd x = spread(-step_);
    x[entering_] = 1;
    return x;
  }

 private:
  Index& at(Index row) { return basis_[static_cast<std::size_t>(row)]; }
  Index at(Index row) const { return basis_[static_cast<std::size_t>(row)]; }

  void factor(const VectorXd& cost) {
    lu_.compute(columns_(Eigen::all, basis_));
    xB_ = lu_.solve(b_);
    y_ = lu_.transpose().solve(cost(basis_));
  }

  Index enteringColumn(const VectorXd& cost, Index allowed, bool takeFirst) const {
    VectorXd reduced = cost.head(allowed) - columns_.leftCols(allowed).transpose() * y_;
    for (const Index j : basis_)
      if (j < allowed) reduced[j] = 0;
    Index best = -1;
    for (Index j = 0; j < allowed && !(takeFirst && best >= 0); ++j)
      if (reduced[j] < (best < 0 ? -kZero : reduced[best])) best = j;
    return best;
  }

  // Of the rows that allow the shortest step, the one with the largest pivot. An artificial column that is
  // still in the basis is zero and has to stay so, hence it leaves first.
  Index leavingRow(bool takeFirst) const {
    const double smallest = kZero * step_.cwiseAbs().maxCoeff();
    const auto ratio = [&](Index i) {
      if (at(i) >= n_ && entering_ < n_ && xB_[i] <= kFeasible && std::abs(step_[i]) > kFeasible) return 0.0;
      if (step_[i] > std::max(kZero, smallest)) return std::max(xB_[i], 0.0) / step_[i];
      return std::numeric_limits<double>::infinity();
    };
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < m_; ++i) least = std::min(least, ratio(i));
    Index best = -1;
    if (least == std::numeric_limits<double>::infinity()) return best;
    for (Index i = 0; i < m_; ++i) {
      if (ratio(i) > least + 1e-12 * (1 + least)) continue;
      const bool isBetter =
          best < 0 || (takeFirst ? at(i) < at(best) : std::abs(step_[i]) > std::abs(step_[best]));
      if (isBetter) best = i;
    }
    return best;
  }

  VectorXd spread(const VectorXd& ofBasis) const {
    VectorXd x = VectorXd::Zero(n_);
    for (Index i = 0; i < m_; ++i)
      if (at(i) < n_) x[at(i)] = std::max(ofBasis[i], 0.0);
    return x;
  }

  Index m_, n_;
  MatrixXd columns_;
  VectorXd b_;
  std::vector<Index> basis_;
  Eigen::PartialPivLU<MatrixXd> lu_;
  VectorXd xB_, y_, step_;
  Index entering_ = -1, iterations_ = 0;
};

void requireProgram(const MatrixArg& A, const VectorArg& b, const VectorArg& c) {
  requireSize("linear program: b", b.size(), A.rows());
  requireSize("linear program: c", c.size(), A.cols());
  if (A.rows() == 0) throw Error({.what = "linear program", .found = "no rows", .wanted = "at least one"});
  for (Index j = 0; j < A.cols(); ++j) requireFinite("linear program: A", VectorXd(A.col(j)));
  requireFinite("linear program: b", b);
  requireFinite("linear program: c", c);
}

}  // namespace

LinearSolution minimizeLinear(const MatrixArg& A, const VectorArg& b, const VectorArg& c) {
  requireProgram(A, b, c);
  const Index m = A.rows(), n = A.cols();
  const VectorXd rowSize = n > 0 ? largestOf(A) : VectorXd::Ones(m);
  const MatrixXd rowsScaled = rowSize.cwiseInverse().asDiagonal() * A;
  const VectorXd columnSize = n > 0 ? largestOf(rowsScaled.transpose()) : VectorXd();
  VectorXd right = b.cwiseQuotient(rowSize), cost(n + m);
  cost << c.cwiseQuotient(columnSize), VectorXd::Zero(m);
  const double bSize = largestOf(right.transpose())[0], cSize = largestOf(cost.transpose())[0];
  right /= bSize;
  cost /= cSize;

  LinearSolution solution;
  Simplex simplex(rowsScaled * columnSize.cwiseInverse().asDiagonal(), right);
  VectorXd missing(n + m);
  missing << VectorXd::Zero(n), VectorXd::Ones(m);
  const bool firstEnded = simplex.minimize(missing, n);
  const bool isInfeasible = firstEnded && simplex.infeasibility() > kFeasible;
  const bool ended = firstEnded && (isInfeasible || simplex.minimize(cost, n));
  solution.iterations = simplex.iterations();
  if (!ended) return solution;
  const bool isUnbounded = !isInfeasible && simplex.isUnbounded();
  solution.status = isInfeasible  ? LinearStatus::kInfeasible
                    : isUnbounded ? LinearStatus::kUnbounded
                                  : LinearStatus::kOptimal;
  solution.y = simplex.y().cwiseQuotient(rowSize);
  if (!isInfeasible) solution.y *= cSize;
  solution.x = isUnbounded ? simplex.ray() : VectorXd(bSize * simplex.x());
  solution.x = solution.x.cwiseQuotient(columnSize);
  if (!isInfeasible && !isUnbounded) solution.value = c.dot(solution.x);
  return solution;
}

}  // namespace rex
