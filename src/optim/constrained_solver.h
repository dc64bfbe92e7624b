#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// The value y (d) of a smooth function at a point, and its Jacobian J (d x n).
struct FunctionValue {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};
using SmoothFunction = std::function<FunctionValue(const VectorArg& x)>;

/// Minimise f(x)^T f(x) + c(x) subject to g(x) <= 0 and h(x) = 0 (slide 5:3, without time). Any of the
/// functions may be empty.
struct ConstrainedProblem {
  SmoothFunction residuals{};     ///< f
  SmoothFunction cost{};          ///< c, one number
  SmoothFunction inequalities{};  ///< g
  SmoothFunction equalities{};    ///< h
  /// Names of the rows of g and h in messages; other rows are numbered: "inequality 3".
  std::vector<std::string> inequalityNames{}, equalityNames{};
};

/// A problem with constraints at a point: its cost, and the values of g(x) <= 0 and h(x) = 0.
struct ConstrainedValues {
  double cost = 0;
  Eigen::VectorXd g{}, h{};
};

/// Weights of the function w cost + a^T g + b^T h whose derivatives are needed, and weights c, d of squared
/// constraint gradients that are added to its second derivatives: sum c_i dg_i^T dg_i + d_i dh_i^T dh_i.
struct ConstraintWeights {
  double cost = 1;             ///< w
  Eigen::VectorXd g{}, h{};    ///< a, b
  Eigen::VectorXd gg{}, hh{};  ///< c, d, not negative
};

/// The interface of constrained problems for solvers, shared by dense problems and the banded ones of
/// trajectories. Implementations own their workspace.
class ConstrainedSystem {
 public:
  virtual ~ConstrainedSystem() = default;

  /// Evaluates functions and their derivatives at x.
  virtual void evaluate(const Eigen::VectorXd& x, ConstrainedValues& values) = 0;
  /// The gradient of the weighted function at the point of the last evaluate().
  virtual void gradientOf(const ConstraintWeights& weights, Eigen::VectorXd& gradient) const = 0;
  /// Stores its second derivatives A at that point, exact or Gauss-Newton, for solve().
  virtual void assemble(const ConstraintWeights& weights) = 0;
  /// The linearised change of g with a step from that point: dg/dx step.
  virtual void changeOfG(const Eigen::VectorXd& step, Eigen::VectorXd& change) const = 0;
  /// step = -(A + damping s I)^-1 gradient, with s the largest entry on A's diagonal, at least one. Returns
  /// false if that matrix is not positive definite.
  virtual bool solve(double damping, const Eigen::VectorXd& gradient, Eigen::VectorXd& step) = 0;
  /// The name of a row of g or h in messages.
  [[nodiscard]] virtual std::string inequalityName(Eigen::Index row) const = 0;
  [[nodiscard]] virtual std::string equalityName(Eigen::Index row) const = 0;
};

/// How constraints enter the objective (slide 5:5).
enum class ConstraintMethod {
  kSquaredPenalty,      ///< mu |[g]+|^2 + mu |h|^2 with increasing mu
  kLogBarrier,          ///< -b sum log(-g) with decreasing b; h as in the augmented Lagrangian
  kAugmentedLagrangian  ///< squared penalties shifted by multipliers, so that mu stays moderate
};

/// As words: "squared penalty", "log barrier", "augmented Lagrangian".
[[nodiscard]] const char* toString(ConstraintMethod method);

struct ConstrainedOptions {
  ConstraintMethod method = ConstraintMethod::kAugmentedLagrangian;
  double tolerance = 1e-8;       ///< of constraints, and of lambda_i g_i = 0
  double stationarity = 1e-8;    ///< of the Lagrangian's gradient, relative to the largest multiplier
  double stepTolerance = 1e-10;  ///< a smaller Newton step, relative to max |x|, also counts as converged
  double penalty = 1;            ///< mu, at the start
  double largestPenalty = 1e12;
  double barrier = 1;  ///< b, at the start
  double factor = 10;  ///< by which penalties grow and barriers shrink
  double damping = 0;  ///< initial damping, relative to second derivatives; changes by factors of ten
  /// Limit on Newton steps, and again (at most 600) on those that find out whether violated constraints can
  /// be satisfied.
  int maxIterations = 1000;
  /// Initial multipliers, from an earlier result; empty: zero.
  Eigen::VectorXd inequalityMultipliers{}, equalityMultipliers{};
};

enum class ConstrainedStatus {
  kSolved,      ///< everything is within its tolerance, or the gradient is as small as rounding allows
  kInfeasible,  ///< no step reduces the violation, or no point inside all inequalities was found
  kNoProgress,  ///< no step along the direction lowers the function, with any damping
  kBudgetSpent,
  kUnbounded,  ///< the cost decreases without bound
  kNotFinite   ///< a function is not finite at the start
};

/// As words: "solved", "infeasible" ...
[[nodiscard]] const char* toString(ConstrainedStatus status);

/// One Newton step and its result.
struct ConstrainedIteration {
  double cost = 0;
  double violation = 0;     ///< max of g and |h|, at least 0
  double stationarity = 0;  ///< max |gradient| of the method's objective before the step
  double step = 0;          ///< the fraction of the full step that was taken
  double damping = 0;
  double parameter = 0;  ///< penalty, or barrier
};

struct ConstrainedResult {
  ConstrainedStatus status = ConstrainedStatus::kNotFinite;
  Eigen::VectorXd x{};
  double cost = std::numeric_limits<double>::infinity();
  Eigen::VectorXd inequalityMultipliers{}, equalityMultipliers{};    ///< in cost + lambda^T g + kappa^T h
  double violation = std::numeric_limits<double>::infinity();        ///< of the most violated constraint
  std::string mostViolated{};                                        ///< its name; empty without constraints
  double stationarity = std::numeric_limits<double>::infinity();     ///< max |gradient of the Lagrangian|
  double complementarity = std::numeric_limits<double>::infinity();  ///< max |min(lambda_i, -g_i)|, with a
                                                                     ///< barrier max |lambda_i g_i|
  double penalty = 0;                                                ///< at the end
  int iterations = 0;
  int evaluations = 0;
  std::vector<ConstrainedIteration> log{};
  std::string message = "no solver has run";
};

/// Minimises the cost under the constraints of a problem from `start` (n), by damped Newton steps with line
/// search, inside the method's loop over penalties, barriers or multipliers. A barrier needs a start inside
/// all inequalities; if it is not, such a point is searched for first. Throws Error for an empty start,
/// numbers that are not finite, options out of range, and multipliers of the wrong size.
[[nodiscard]] ConstrainedResult solveConstrained(ConstrainedSystem& system, const VectorArg& start,
                                                 const ConstrainedOptions& options = {});

/// The same for a dense problem. Second derivatives of f use the Gauss-Newton approximation; those of
/// `cost` and the constraints are differences of gradients, unless there is no `cost`. Also throws for a
/// problem without f and c, and for functions whose values or Jacobians have the wrong size.
[[nodiscard]] ConstrainedResult solveConstrained(const ConstrainedProblem& problem, const VectorArg& start,
                                                 const ConstrainedOptions& options = {});

}  // namespace rex
