#pragma once

#include "optim/constrained_solver.h"
#include "optim/constraint_merit_internal.h"

namespace rex::internal {

/// Why a descent ended.
enum class DescentEnd {
  kConverged,  ///< gradient or step are small enough
  kInside,     ///< all inequalities are below zero, where that is what is wanted
  kNoProgress,
  kBudgetSpent,
  kUnbounded
};

/// Damped Newton steps with line search on a merit function. It keeps the point, and what the system said
/// there, from one merit to the next, and allocates nothing once it has taken a step.
class ConstrainedDescent {
 public:
  ConstrainedDescent(ConstrainedSystem& system, const VectorArg& start, const ConstrainedOptions& options,
                     ConstrainedResult& result);

  [[nodiscard]] const Eigen::VectorXd& x() const { return x_; }
  [[nodiscard]] const ConstrainedValues& values() const { return values_; }
  /// Until max |gradient| is at most `tolerance`, or, if so wanted, until all g < 0.
  DescentEnd descend(const ConstraintMerit& merit, double tolerance, bool isForInside = false);
  /// Goes on from another point.
  void moveTo(const Eigen::VectorXd& x);
  /// So many Newton steps more than options allow.
  void extendBudget(int steps) { budget_ += steps; }
  /// Gradient of w cost + a^T g + b^T h at x.
  const Eigen::VectorXd& gradientOf(const ConstraintWeights& weights);

 private:
  void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values);
  bool takeStep(const ConstraintMerit& merit, double value);
  bool findStep(const ConstraintMerit& merit);
  bool searchAlong(const ConstraintMerit& merit, double value, double slope);
  [[nodiscard]] bool isNoBetter(double value, double lastValue, double stationarity,
                                double lastStationarity) const;
  [[nodiscard]] bool isSmall(double tolerance) const;
  void accept(double share);
  void note(const ConstraintMerit& merit, double stationarity);

  ConstrainedSystem& system_;
  const ConstrainedOptions& options_;
  ConstrainedResult& result_;
  Eigen::VectorXd x_, trial_, step_, gradient_, stepGradient_, change_;
  ConstrainedValues values_, trialValues_;
  ConstraintWeights weights_;
  double damping_, share_ = 0, gain_ = 0, unbounded_ = 0;
  int budget_;
  bool isAtX_ = true;  // the system was evaluated at x last
};

/// max of g and |h|, at least 0.
[[nodiscard]] double violationOf(const ConstrainedValues& values);

}  // namespace rex::internal
