#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "optim/constrained_solver.h"

namespace rex {

/// The input of a term of order k: k + 1 consecutive configurations.
struct TrajectoryWindow {
  int t;        ///< the step of the last one
  double tau;   ///< seconds from one to the next
  MatrixArg X;  ///< n x (k + 1): x_{t-k} ... x_t
};

/// Writes y (d) and J (d x (k + 1) n, the columns of x_{t-k} first) into storage that is reused. d must not
/// change.
using TermFunction = std::function<void(const TrajectoryWindow&, FunctionValue&)>;

enum class TermKind {
  kCost,        ///< costs y^T y
  kInequality,  ///< y <= 0
  kEquality     ///< y = 0
};

/// One of the f_t, g_t or h_t(x_{t-k:t}) of slide 5:3, at each step from `first` to `last`.
struct TrajectoryTerm {
  std::string name{};  ///< for messages
  TermKind kind = TermKind::kCost;
  int order = 0;  ///< k
  TermFunction function{};
  int first = 0;
  std::optional<int> last{};  ///< inclusive; empty: to the end
};

/// The same term at other steps, at a single step, and in another role.
[[nodiscard]] TrajectoryTerm during(TrajectoryTerm term, int first, int last);
[[nodiscard]] TrajectoryTerm at(TrajectoryTerm term, int t);
[[nodiscard]] TrajectoryTerm as(TermKind kind, TrajectoryTerm term);

/// The k-order problem of slide 5:3: T unknown configurations x_0 ... x_{T-1} of n numbers, tau seconds
/// apart, after a given prefix ... x_{-1}. The last configuration of the prefix is at time 0, so x_t is at
/// (t + 1) tau and the motion takes T tau. The slide's T is one less.
class TrajectoryProblem {
 public:
  /// `prefix`: n x k or more columns, at least one. Throws Error if n or the number of steps is zero and
  /// for a tau that is not positive. Also throws Error naming a term that has no function, looks further
  /// back than the prefix, or is at no step of the trajectory.
  TrajectoryProblem(std::vector<TrajectoryTerm> terms, const MatrixArg& prefix, int steps, double tau = 1);

  [[nodiscard]] const std::vector<TrajectoryTerm>& terms() const { return terms_; }
  [[nodiscard]] const Eigen::MatrixXd& prefix() const { return prefix_; }
  [[nodiscard]] int n() const { return static_cast<int>(prefix_.rows()); }
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] double tau() const { return tau_; }
  /// The largest order of a term.
  [[nodiscard]] int order() const;

 private:
  std::vector<TrajectoryTerm> terms_;
  Eigen::MatrixXd prefix_;
  int steps_;
  double tau_;
};

/// A trajectory and how it was found. Multipliers are ordered by term, then by step.
struct TrajectoryResult {
  Eigen::MatrixXd X{};  ///< n x T
  ConstrainedResult solution{};
};

/// Minimises the costs of a k-order problem under its constraints (slides 5:3 and 5:5) from `start` (n x
/// T), with the methods of solveConstrained(). The Hessian is banded, so a step takes time proportional to
/// T. For a warm start, pass an earlier X, with its multipliers and penalty in `options`. The status names
/// the most violated constraint with its step. Throws Error for a start of the wrong size, terms whose
/// values change size or whose Jacobians have the wrong size, and like solveConstrained().
[[nodiscard]] TrajectoryResult optimizeTrajectory(const TrajectoryProblem& problem, const MatrixArg& start,
                                                  const ConstrainedOptions& options = {});

/// T configurations (n x T) on the straight line, the first one step away from `from`, the last at `to`: a
/// start for optimizeTrajectory(). Throws Error for vectors of different sizes and T < 1.
[[nodiscard]] Eigen::MatrixXd straightTrajectory(const VectorArg& from, const VectorArg& to, int steps);

/// The shortest time step, seconds, for which the differences of the path (n x N, one configuration per
/// column) respect limits of velocity and acceleration (n, positive; empty: none). They scale with 1/tau
/// and 1/tau^2. Returns 0 without limits. Throws Error for limits of the wrong size or not positive.
[[nodiscard]] double shortestTau(const MatrixArg& path, const Eigen::VectorXd& velocityLimit,
                                 const Eigen::VectorXd& accelerationLimit);

}  // namespace rex
