#include <algorithm>
#include <cmath>

#include "optim/constrained_descent_internal.h"

namespace rex::internal {
namespace {

constexpr double kSlopeShare = 0.1;      // of what the slope promises, a step must gain (Armijo)
constexpr double kShortestShare = 1e-3;  // of a step; then more damping turns it instead
constexpr double kLeastDamping = 1e-10, kMostDamping = 1e8;
constexpr int kMostAttempts = 10;        // to find out which inequalities count for a step
constexpr double kUnboundedFall = 1e12;  // of the cost, relative to that at the start
constexpr double kRounding = 1e-15;      // of sums that make up a merit

double largestOf(const Eigen::VectorXd& v) { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0; }

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
    if (stationarity <= tolerance * std::max({1., largestOf(weights_.g), largestOf(weights_.h)}))
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
