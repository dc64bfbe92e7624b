#pragma once

#include <Eigen/Cholesky>

#include "optim/constrained_solver.h"

namespace rex::internal {

/// The function without constraints that a method minimises in place of a problem with some, for one value of
/// its parameters: of g, h and cost at a point, and with its derivatives as weights of theirs.
struct ConstraintMerit {
  bool hasBarrier = false;
  double costWeight = 1;
  double penalty = 1, barrier = 1;
  double margin = 0;                  ///< g + margin <= 0 is wanted, where there is no barrier
  Eigen::VectorXd lambda{}, kappa{};  ///< multipliers that shift the squared penalties

  /// Infinite where a barrier does not hold.
  [[nodiscard]] double value(const ConstrainedValues& at) const;
  void weigh(const ConstrainedValues& at, ConstraintWeights& weights) const;
  /// The same, but without a barrier, and with the inequalities that count for a step being those that would
  /// where g has `change`d. Whether they are others than before.
  [[nodiscard]] bool weighAhead(const ConstrainedValues& at, const Eigen::VectorXd& change,
                                ConstraintWeights& weights) const;
  /// Multipliers that make the gradient of the Lagrangian that of this function.
  void updateMultipliers(const ConstrainedValues& at, Eigen::VectorXd& ofG, Eigen::VectorXd& ofH) const;
};

/// A dense problem as solvers see it. Keeps references to the problem.
class DenseSystem final : public ConstrainedSystem {
 public:
  /// n: the size of points.
  DenseSystem(const ConstrainedProblem& problem, Eigen::Index n) : problem_(problem), n_(n) {}

  void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) override;
  void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const override;
  void assemble(const ConstraintWeights& weights) override;
  void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const override;
  bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) override;
  [[nodiscard]] std::string inequalityName(Eigen::Index row) const override;
  [[nodiscard]] std::string equalityName(Eigen::Index row) const override;

 private:
  [[nodiscard]] FunctionValue valueOf(const SmoothFunction& function, const char* name,
                                      const VectorArg& x) const;
  void addCurvature(const ConstraintWeights& weights);

  const ConstrainedProblem& problem_;
  Eigen::Index n_;
  Eigen::VectorXd x_;
  FunctionValue residuals_, cost_, g_, h_;
  Eigen::MatrixXd A_, damped_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

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
