#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/linear_system.h"
#include "control/regulators.h"
#include "optim/quadratic_program.h"

namespace rex {

/// What a PredictiveController minimises: the sum of x_t^T Q x_t + u_t^T R u_t over `horizon` steps plus
/// x_N^T F x_N, in differences from the target, within limits. Limits are empty, or have an entry (infinite:
/// no limit) for each state or control; those of the states hold from x_1 on.
struct PredictiveOptions {
  Eigen::MatrixXd Q{};  ///< n x n, positive semidefinite
  Eigen::MatrixXd R{};  ///< m x m, positive definite
  Eigen::MatrixXd F{};  ///< n x n; empty: the cost of the regulator lqr() for all times after the horizon
  int horizon = 20;
  Eigen::VectorXd uMin{}, uMax{}, xMin{}, xMax{};
  /// Above 0, states may be outside their limits by s_t, at the cost slackWeight (s_t + s_t^2); 0: never.
  double slackWeight = 0;
};

/// The best motion from x on. If no motion keeps the limits, status is kInfeasible, and the message names a
/// limit.
struct PredictedMotion {
  QuadraticStatus status = QuadraticStatus::kStalled;
  Eigen::MatrixXd X{};   ///< n x (N + 1)
  Eigen::MatrixXd U{};   ///< m x N
  double cost = 0;       ///< includes that of s_t
  double residual = 0;   ///< of the optimality conditions: QuadraticSolution::residual
  double violation = 0;  ///< the largest s_t
  std::vector<int> active{};
  int iterations = 0;
  std::string message{};
};

/// Linear model-predictive control: x_{t+1} = A x_t + B u_t, as one quadratic program in the controls
/// (Rawlings, Mayne and Diehl 2017, chapters 1 and 8). Without limits that act, its control is that of lqr().
class PredictiveController {
 public:
  /// Throws Error for a system in continuous time, sizes that do not fit, numbers that are not finite,
  /// weights that are not as demanded, lower limits above upper ones, no steps, and if F is empty and lqr()
  /// has no solution.
  PredictiveController(const LinearSystem& system, const PredictiveOptions& options);

  /// Plans from state x towards a target; `last`, the motion planned one step ago, makes that faster. A
  /// target that is no equilibrium is not reached. Throws Error for sizes that do not fit and numbers that
  /// are not finite.
  [[nodiscard]] PredictedMotion plan(const VectorArg& x, const RestPoint& target,
                                     const PredictedMotion* last = nullptr) const;
  /// The same towards x = 0, u = 0.
  [[nodiscard]] PredictedMotion plan(const VectorArg& x, const PredictedMotion* last = nullptr) const;

 private:
  // A limit of one step t: of u_t, of x_{t+1}, or s_t >= 0. Slack is -1 above an upper limit, 1 below a lower
  // one.
  enum class Of { kControl, kState, kSlack };
  struct Limit {
    Of of;
    int index;
    double lower, upper, slack;
  };
  [[nodiscard]] std::vector<Limit> limitsPerStep() const;
  [[nodiscard]] Eigen::MatrixXd limitRows() const;
  [[nodiscard]] std::string whyNot(const Eigen::VectorXd& y) const;
  void describe(PredictedMotion& motion, const QuadraticSolution& solution, const RestPoint& target,
                const Eigen::VectorXd& x) const;

  LinearSystem system_;
  PredictiveOptions options_;
  int n_ = 0, m_ = 0, N_ = 0;
  std::vector<Limit> limits_{};
  Eigen::MatrixXd response_{};  // N n x N m: of x_1, ..., x_N to the controls
  Eigen::MatrixXd weighted_{};  // the same, times Q or F
  std::optional<QuadraticProgram> program_{};
};

}  // namespace rex
