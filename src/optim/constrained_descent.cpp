#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "optim/constrained_descent_internal.h"

namespace rex::internal {

// An inequality costs mu [g + lambda / 2 mu]+^2, an equality mu (h + kappa / 2 mu)^2, each less what it costs
// at 0 without a shift (Nocedal and Wright, Numerical Optimization, 17.4, with 2 mu for their mu).
double ConstraintMerit::value(const ConstrainedValues& at) const {
  double sum = costWeight * at.cost;
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    if (hasBarrier) {
      if (!(at.g[i] < 0)) return std::numeric_limits<double>::infinity();
      sum -= barrier * std::log(-at.g[i]);
    } else {
      const double g = at.g[i] + margin, shifted = g + lambda[i] / (2 * penalty);
      sum += shifted <= 0 ? -lambda[i] * lambda[i] / (4 * penalty)
                          : g * (penalty * g + lambda[i]);  // NaN stays NaN
    }
  }
  for (Eigen::Index i = 0; i < at.h.size(); ++i) sum += at.h[i] * (penalty * at.h[i] + kappa[i]);
  return sum;
}

void ConstraintMerit::updateMultipliers(const ConstrainedValues& at, Eigen::VectorXd& ofG,
                                        Eigen::VectorXd& ofH) const {
  for (Eigen::Index i = 0; i < at.g.size(); ++i)
    ofG[i] = hasBarrier ? -barrier / at.g[i] : std::max(0., 2 * penalty * (at.g[i] + margin) + lambda[i]);
  for (Eigen::Index i = 0; i < at.h.size(); ++i) ofH[i] = 2 * penalty * at.h[i] + kappa[i];
}

void ConstraintMerit::weigh(const ConstrainedValues& at, ConstraintWeights& weights) const {
  weights.cost = costWeight;
  weights.g.resize(at.g.size());
  weights.gg.resize(at.g.size());
  weights.h.resize(at.h.size());
  weights.hh.setConstant(at.h.size(), 2 * penalty);
  updateMultipliers(at, weights.g, weights.h);
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    if (hasBarrier)
      weights.gg[i] = barrier / (at.g[i] * at.g[i]);
    else
      weights.gg[i] = weights.g[i] > 0 ? 2 * penalty : 0;
  }
}

bool ConstraintMerit::weighAhead(const ConstrainedValues& at, const Eigen::VectorXd& change,
                                 ConstraintWeights& weights) const {
  bool isOther = false;
  for (Eigen::Index i = 0; i < at.g.size(); ++i) {
    const double here = 2 * penalty * (at.g[i] + margin) + lambda[i];
    const bool counts = here + 2 * penalty * change[i] > 0;
    isOther = isOther || counts != (weights.gg[i] > 0);
    weights.g[i] = counts ? here : 0;
    weights.gg[i] = counts ? 2 * penalty : 0;
  }
  return isOther;
}

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

namespace {

constexpr double kSlopeShare = 0.1;      // of what the slope promises, a step must gain (Armijo)
constexpr double kShortestShare = 1e-3;  // of a step; then more damping turns it instead
constexpr double kLeastDamping = 1e-10, kMostDamping = 1e8;
constexpr int kMostAttempts = 10;        // to find out which inequalities count for a step
constexpr double kUnboundedFall = 1e12;  // of the cost, relative to that at the start
constexpr double kRounding = 1e-15;      // of sums that make up a merit

}  // namespace

double violationOf(const ConstrainedValues& values) {
  double violation = 0;
  for (const double g : values.g) violation = std::max(violation, g);
  for (const double h : values.h) violation = std::max(violation, std::abs(h));
  return violation;
}

ConstrainedDescent::ConstrainedDescent(ConstrainedSystem& system, const VectorArg& start,
                                       const ConstrainedOptions& options, ConstrainedResult& result)
    : system_(system),
      options_(options),
      result_(result),
      x_(start),
      trial_(start),
      step_(start),
      gradient_(start),
      damping_(options.damping),
      budget_(options.maxIterations) {
  result_.log.reserve(static_cast<std::size_t>(std::min(options.maxIterations, 10'000)));
  evaluate(x_, values_);
  trialValues_ = values_;
  unbounded_ = -kUnboundedFall * (1 + std::abs(values_.cost));
}

void ConstrainedDescent::evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) {
  system_.evaluate(x, values);
  ++result_.evaluations;
}

void ConstrainedDescent::moveTo(const Eigen::VectorXd& x) {
  x_ = x;
  evaluate(x_, values_);
  isAtX_ = true;
}

const Eigen::VectorXd& ConstrainedDescent::gradientOf(const ConstraintWeights& weights) {
  if (!isAtX_) evaluate(x_, values_);
  isAtX_ = true;
  system_.gradientOf(weights, gradient_);
  return gradient_;
}

DescentEnd ConstrainedDescent::descend(const ConstraintMerit& merit, double tolerance, bool isForInside) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double lastValue = kInfinity, lastStationarity = kInfinity;
  for (;;) {
    if (isForInside && (values_.g.array() < 0).all()) return DescentEnd::kInside;
    merit.weigh(values_, weights_);
    const double stationarity = gradientOf(weights_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (stationarity <= tolerance * std::max({1., weights_.g.lpNorm<Eigen::Infinity>(),
                                              weights_.h.lpNorm<Eigen::Infinity>()}))
      return DescentEnd::kConverged;
    if (result_.iterations >= budget_) return DescentEnd::kBudgetSpent;
    const double value = merit.value(values_);
    if (isNoBetter(value, lastValue, stationarity, lastStationarity)) return DescentEnd::kConverged;
    lastValue = value, lastStationarity = stationarity;
    if (!takeStep(merit, value))
      return gain_ > 0 && gain_ <= 100 * kRounding * std::abs(value) ? DescentEnd::kConverged
                                                                     : DescentEnd::kNoProgress;
    note(merit, stationarity);
    if (merit.costWeight * values_.cost < unbounded_) return DescentEnd::kUnbounded;
    if (share_ == 1 && damping_ <= kLeastDamping && isSmall(options_.stepTolerance))
      return DescentEnd::kConverged;
  }
}

// Whether a small step has changed the value by no more than its rounding, and has not helped the gradient.
bool ConstrainedDescent::isNoBetter(double value, double lastValue, double stationarity,
                                    double lastStationarity) const {
  return lastValue <= value + kRounding * std::abs(value) && stationarity > lastStationarity / 2 &&
         isSmall(1e-6);
}

bool ConstrainedDescent::isSmall(double tolerance) const {
  return share_ * step_.cwiseAbs().maxCoeff() <= tolerance * std::max(1., x_.cwiseAbs().maxCoeff());
}

// Increases Levenberg's damping as long as a direction is not one of descent, or leads nowhere.
bool ConstrainedDescent::takeStep(const ConstraintMerit& merit, double value) {
  gain_ = 0;
  stepGradient_ = gradient_;
  while (damping_ <= kMostDamping) {
    if (findStep(merit)) {
      const double slope = gradient_.dot(step_);
      gain_ = std::max(gain_, -slope);
      if (slope < 0 && searchAlong(merit, value, slope)) {
        if (share_ == 1) damping_ /= 10;
        if (share_ < 0.25) damping_ = std::max(4 * damping_, kLeastDamping);
        if (damping_ < kLeastDamping) damping_ = 0;
        return true;
      }
    }
    damping_ = std::max(10 * damping_, kLeastDamping);
  }
  damping_ = options_.damping;
  return false;
}

// The minimum of the merit if cost and constraints were quadratic and linear. Which inequalities count is not
// known before the step, so it is repeated with those that the last one would reach, until they no longer
// change.
bool ConstrainedDescent::findStep(const ConstraintMerit& merit) {
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    system_.assemble(weights_);
    if (!system_.solve(damping_, stepGradient_, step_)) {
      merit.weigh(values_, weights_);  // no guesses until the cost is convex without the inequalities
      stepGradient_ = gradient_;
      return false;
    }
    if (merit.hasBarrier) return true;
    system_.changeOfG(step_, change_);
    if (!merit.weighAhead(values_, change_, weights_)) return true;
    system_.gradientOf(weights_, stepGradient_);
  }
  return true;
}

bool ConstrainedDescent::searchAlong(const ConstraintMerit& merit, double value, double slope) {
  for (double share = 1; share >= kShortestShare; share /= 2) {
    trial_ = x_ + share * step_;
    evaluate(trial_, trialValues_);
    isAtX_ = false;
    const double there = merit.value(trialValues_);
    if (there <= value + kSlopeShare * share * slope + kRounding * std::abs(value)) {
      accept(share);
      return true;
    }
  }
  return false;
}

void ConstrainedDescent::accept(double share) {
  share_ = share;
  std::swap(x_, trial_);
  std::swap(values_, trialValues_);
  isAtX_ = true;
}

void ConstrainedDescent::note(const ConstraintMerit& merit, double stationarity) {
  ++result_.iterations;
  result_.log.push_back({.cost = values_.cost,
                         .violation = violationOf(values_),
                         .stationarity = stationarity,
                         .step = share_,
                         .damping = damping_,
                         .parameter = merit.hasBarrier ? merit.barrier : merit.penalty});
}

}  // namespace rex::internal
