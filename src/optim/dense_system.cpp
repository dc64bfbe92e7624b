#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "optim/dense_system_internal.h"

namespace rex::internal {

FunctionValue DenseSystem::valueOf(const SmoothFunction& function, const char* name,
                                   const VectorArg& x) const {
  if (!function) return {Eigen::VectorXd(0), Eigen::MatrixXd(0, n_)};
  FunctionValue value = function(x);
  if (value.J.rows() == value.y.size() && value.J.cols() == n_) return value;
  throw Error({.what = fmt::format("{}: Jacobian", name),
               .found = fmt::format("{} x {}", value.J.rows(), value.J.cols()),
               .wanted = fmt::format("{} x {}", value.y.size(), n_)});
}

void DenseSystem::evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) {
  x_ = x;
  residuals_ = valueOf(problem_.residuals, "residuals", x);
  cost_ = valueOf(problem_.cost, "cost", x);
  if (problem_.cost) requireSize("cost", cost_.y.size(), 1);
  g_ = valueOf(problem_.inequalities, "inequalities", x);
  h_ = valueOf(problem_.equalities, "equalities", x);
  values.cost = residuals_.y.squaredNorm() + cost_.y.sum();
  values.g = g_.y;
  values.h = h_.y;
}

void DenseSystem::gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const {
  gradient = 2 * weights.cost * (residuals_.J.transpose() * residuals_.y);
  if (problem_.cost) gradient += weights.cost * cost_.J.row(0).transpose();
  gradient += g_.J.transpose() * weights.g + h_.J.transpose() * weights.h;
}

void DenseSystem::changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const {
  change = g_.J * step;
}

void DenseSystem::assemble(const ConstraintWeights& weights) {
  A_ = 2 * weights.cost * (residuals_.J.transpose() * residuals_.J);
  A_ += g_.J.transpose() * weights.gg.asDiagonal() * g_.J;
  A_ += h_.J.transpose() * weights.hh.asDiagonal() * h_.J;
  if (problem_.cost && weights.cost > 0) addCurvature(weights);
}

// Second derivatives of w cost + a^T g + b^T h, with a and b held; constraints that only a step will reach
// have none yet.
void DenseSystem::addCurvature(const ConstraintWeights& weights) {
  const auto gradientAt = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return weights.cost * valueOf(problem_.cost, "cost", x).J.transpose() +
           valueOf(problem_.inequalities, "inequalities", x).J.transpose() * weights.g.cwiseMax(0) +
           valueOf(problem_.equalities, "equalities", x).J.transpose() * weights.h;
  };
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd H(n_, n_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double size = kStep * std::max(1., std::abs(x_[i]));
    const Eigen::VectorXd move = size * Eigen::VectorXd::Unit(n_, i);
    H.col(i) = (gradientAt(x_ + move) - gradientAt(x_ - move)) / (2 * size);
  }
  // If the functions are not defined all around, damping has to suffice.
  if (H.allFinite()) A_ += (H + H.transpose()) / 2;
}

bool DenseSystem::solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) {
  damped_ = A_;
  damped_.diagonal().array() += damping * std::max(1., A_.diagonal().maxCoeff());
  factors_.compute(damped_);
  if (factors_.info() != Eigen::Success) return false;
  step = -factors_.solve(gradient);
  return step.allFinite();
}

namespace {

std::string nameOfRow(const std::vector<std::string>& names, const char* kind, Eigen::Index row) {
  const auto i = static_cast<std::size_t>(row);
  return i < names.size() ? names[i] : fmt::format("{} {}", kind, row);
}

}  // namespace

std::string DenseSystem::inequalityName(Eigen::Index row) const {
  return nameOfRow(problem_.inequalityNames, "inequality", row);
}

std::string DenseSystem::equalityName(Eigen::Index row) const {
  return nameOfRow(problem_.equalityNames, "equality", row);
}

}  // namespace rex::internal
