#include "optim/quadratic_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kAllowed =
    1e-11;  // violation of a bound, relative to the largest number of the bounds and of x
constexpr double kTiny = 1e-300;      // against division by zero
constexpr double kDependent = 1e-10;  // what is left of a row beside the active ones, relative to the row

// A row that holds with equality: sign * a.x = sign * bound, with the multiplier u >= 0.
struct ActiveRow {
  Index row;
  double sign, bound, u;
  bool isEquation;
};

// Keeps x the minimum subject to the active rows alone, and J^T N = (R; 0) for their normals N (as columns).
class DualActiveSet {
 public:
  DualActiveSet(const MatrixXd& J, const MatrixXd& At, const VectorXd& g, const VectorXd& lower,
                const VectorXd& upper)
      : At_(At), g_(g), lower_(lower), upper_(upper), J_(J), R_(MatrixXd::Zero(g.size(), g.size())) {
    x_ = -J_ * (J_.transpose() * g_);
    scale_ = x_.lpNorm<Eigen::Infinity>();
    for (const VectorXd* bounds : {&lower_, &upper_})
      for (const double bound : *bounds)
        if (std::isfinite(bound)) scale_ = std::max(scale_, std::abs(bound));
  }

  QuadraticStatus minimize(const std::vector<int>& guess) {
    for (const int row : guess)
      if (violation(row) > kAllowed * scale_ && !add(row)) return status_;
    for (Index row = worstRow(); row >= 0; row = worstRow())
      if (!add(row)) return status_;
    polish();
    return QuadraticStatus::kOptimal;
  }

  const VectorXd& x() const { return x_; }
  int iterations() const { return iterations_; }
  double scale() const { return scale_; }
  double largestViolation() const {
    double largest = 0;
    for (Index row = 0; row < At_.cols(); ++row) largest = std::max(largest, violation(row));
    return largest;
  }
  std::vector<int> activeRows() const {
    std::vector<int> rows;
    for (const ActiveRow& a : active_) rows.push_back(static_cast<int>(a.row));
    return rows;
  }
  // For rows of length one; those of the proof if the status is kInfeasible.
  VectorXd multipliers() const {
    VectorXd y = VectorXd::Zero(At_.cols());
    for (const ActiveRow& a : active_) y[a.row] += a.sign * a.u;
    return y;
  }

 private:
  double violation(Index row) const {
    const double value = At_.col(row).dot(x_);
    return std::max(lower_[row] - value, value - upper_[row]);
  }

  Index worstRow() const {
    Index worst = -1;
    double most = kAllowed * scale_;
    for (Index row = 0; row < At_.cols(); ++row)
      if (const double v = violation(row); v > most) worst = row, most = v;
    return worst;
  }

  // Steps until the row holds, dropping others whose multipliers would become negative; false if that ends
  // the search, with the reason in status_.
  bool add(Index row) {
    ActiveRow entering{
        .row = row, .sign = 1, .bound = lower_[row], .u = 0, .isEquation = lower_[row] == upper_[row]};
    if (At_.col(row).dot(x_) > upper_[row]) entering.sign = -1, entering.bound = -upper_[row];
    const VectorXd normal = entering.sign * At_.col(row);
    for (const int most = 100 + 20 * static_cast<int>(At_.cols() + g_.size()); iterations_ < most;
         ++iterations_) {
      const Index q = count(), rest = g_.size() - q;
      const VectorXd d = J_.transpose() * normal;
      const double free = d.tail(rest).norm();
      VectorXd r = R_.topLeftCorner(q, q).triangularView<Eigen::Upper>().solve(d.head(q));
      const Index leaving = firstToLeave(r);
      const double untilOneLeaves = leaving < 0 ? kInfinite : at(leaving).u / r[leaving];
      const bool isDependent = free <= kDependent * d.norm();
      const double untilItHolds = isDependent ? kInfinite : (entering.bound - normal.dot(x_)) / (free * free);
      const double step = std::min(untilOneLeaves, untilItHolds);
      if (step == kInfinite) return proveInfeasible(entering, r);
      if (!isDependent) x_ += step * (J_.rightCols(rest) * d.tail(rest));
      for (Index i = 0; i < q; ++i) at(i).u -= step * r[i];
      entering.u += step;
      if (untilItHolds <= untilOneLeaves) {
        append(entering, d);
        ++iterations_;
        return true;
      }
      drop(leaving);
    }
    status_ = QuadraticStatus::kStalled;
    return false;
  }

  // normal = N r: the active rows forbid what the entering one wants.
  bool proveInfeasible(const ActiveRow& entering, const VectorXd& r) {
    for (Index i = 0; i < count(); ++i) at(i).u = -r[i];
    active_.push_back(entering);
    active_.back().u = 1;
    status_ = QuadraticStatus::kInfeasible;
    return false;
  }

  Index firstToLeave(const VectorXd& r) const {
    Index first = -1;
    for (Index i = 0; i < count(); ++i) {
      if (at(i).isEquation || r[i] <= 0) continue;
      if (first < 0 || at(i).u * r[first] < at(first).u * r[i]) first = i;
    }
    return first;
  }

  // A reflection of the last columns of J turns the free part of d into one number.
  void append(const ActiveRow& entering, const VectorXd& d) {
    const Index q = count(), rest = g_.size() - q;
    VectorXd essential(std::max<Index>(rest - 1, 0)), work(J_.rows());
    double tau = 0, beta = 0;
    d.tail(rest).makeHouseholder(essential, tau, beta);
    J_.rightCols(rest).applyHouseholderOnTheRight(essential, tau, work.data());
    R_.col(q).head(q) = d.head(q);
    R_(q, q) = beta;
    active_.push_back(entering);
  }

  // Rotations make R triangular again without its column k.
  void drop(Index k) {
    const Index q = count();
    for (Index j = k + 1; j < q; ++j) {
      R_.col(j - 1).head(j + 1) = R_.col(j).head(j + 1);
      Eigen::JacobiRotation<double> rotation;
      rotation.makeGivens(R_(j - 1, j - 1), R_(j, j - 1));
      R_.block(0, j - 1, q, 1).applyOnTheLeft(j - 1, j, rotation.adjoint());
      R_.block(0, j + 1, q, q - j - 1).applyOnTheLeft(j - 1, j, rotation.adjoint());
      J_.applyOnTheRight(j - 1, j, rotation);
    }
    R_.col(q - 1).setZero();
    active_.erase(active_.begin() + k);
  }

  // x and the multipliers, recomputed from the active rows, without the rounding errors of the steps.
  void polish() {
    const Index q = count(), rest = g_.size() - q;
    VectorXd bound(q);
    for (Index i = 0; i < q; ++i) bound[i] = at(i).bound;
    const auto R = R_.topLeftCorner(q, q).triangularView<Eigen::Upper>();
    const VectorXd w = R.transpose().solve(bound);
    x_ = J_.leftCols(q) * w - J_.rightCols(rest) * (J_.rightCols(rest).transpose() * g_);
    const VectorXd u = R.solve(VectorXd(w + J_.leftCols(q).transpose() * g_));
    for (Index i = 0; i < q; ++i) at(i).u = at(i).isEquation ? u[i] : std::max(u[i], 0.0);
  }

  Index count() const { return static_cast<Index>(active_.size()); }
  ActiveRow& at(Index i) { return active_[static_cast<std::size_t>(i)]; }
  const ActiveRow& at(Index i) const { return active_[static_cast<std::size_t>(i)]; }

  const MatrixXd& At_;
  const VectorXd &g_, &lower_, &upper_;
  MatrixXd J_, R_;
  VectorXd x_;
  std::vector<ActiveRow> active_;
  double scale_ = 0;
  int iterations_ = 0;
  QuadraticStatus status_ = QuadraticStatus::kStalled;
};

void requireBounds(const VectorArg& lower, const VectorArg& upper) {
  for (Index i = 0; i < lower.size(); ++i) {
    const bool isInterval = lower[i] <= upper[i] && lower[i] < kInfinite && upper[i] > -kInfinite;
    if (!isInterval)
      throw Error({.what = fmt::format("quadratic program: row {}", i),
                   .found = fmt::format("bounds {:g} and {:g}", lower[i], upper[i]),
                   .wanted = "lower <= upper"});
  }
}

}  // namespace

QuadraticProgram::QuadraticProgram(const MatrixArg& H, const MatrixArg& A) : H_(H), At_(A.transpose()) {
  const Index n = H.rows();
  requireSize("quadratic program: columns of H", H.cols(), n);
  requireSize("quadratic program: columns of A", A.cols(), n);
  for (Index j = 0; j < n; ++j) {
    requireFinite("quadratic program: H", H.col(j));
    requireFinite("quadratic program: A", A.col(j));
  }
  H_ = ((H + H.transpose()) / 2).eval();
  const Eigen::LLT<MatrixXd> factor(H_);
  if (factor.info() != Eigen::Success)
    throw Error({.what = "quadratic program", .found = "an H that is not positive definite"});
  J_ = factor.matrixU().solve(MatrixXd::Identity(n, n));
  rowLength_ = n > 0 ? VectorXd(A.rowwise().norm()) : VectorXd::Zero(A.rows());
  rowLength_ = (rowLength_.array() > 0).select(rowLength_, 1);
  At_ = At_ * rowLength_.cwiseInverse().asDiagonal();
}

QuadraticSolution QuadraticProgram::minimize(const VectorArg& g, const VectorArg& lower,
                                             const VectorArg& upper, const std::vector<int>& guess) const {
  requireSize("quadratic program: g", g.size(), H_.rows());
  requireSize("quadratic program: lower", lower.size(), At_.cols());
  requireSize("quadratic program: upper", upper.size(), At_.cols());
  requireFinite("quadratic program: g", g);
  requireBounds(lower, upper);
  for (const int row : guess)
    if (row < 0 || row >= At_.cols())
      throw Error({.what = "quadratic program: guess",
                   .found = fmt::format("row {}", row),
                   .wanted = fmt::format("one of {} rows", At_.cols())});

  const VectorXd cost = g, low = lower.cwiseQuotient(rowLength_), high = upper.cwiseQuotient(rowLength_);
  DualActiveSet search(J_, At_, cost, low, high);
  QuadraticSolution solution;
  solution.status = search.minimize(guess);
  solution.iterations = search.iterations();
  if (solution.status == QuadraticStatus::kStalled) return solution;
  const VectorXd y = search.multipliers();
  solution.y = y.cwiseQuotient(rowLength_);
  solution.active = search.activeRows();
  if (solution.status == QuadraticStatus::kInfeasible) return solution;
  solution.x = search.x();
  const VectorXd slope = H_ * solution.x;
  solution.value = solution.x.dot(slope / 2 + g);
  const double largestSlope = std::max(g.lpNorm<Eigen::Infinity>(), slope.lpNorm<Eigen::Infinity>());
  solution.residual =
      std::max(VectorXd(slope + g - At_ * y).lpNorm<Eigen::Infinity>() / std::max(largestSlope, kTiny),
               search.largestViolation() / std::max(search.scale(), kTiny));
  return solution;
}

}  // namespace rex
