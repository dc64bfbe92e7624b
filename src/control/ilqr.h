#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

/// A motion in N steps, x_{t+1} = next(x_t, u_t), whose cost is a sum of squares: |stage(x_t, u_t, t)|^2
/// for each step plus |final(x_N)|^2.
struct ControlProblem {
  ControlledMotion next{};
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& u, int t)> stage{};
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> final{};
  Eigen::VectorXd start{};
  /// Derivatives of `next`, of `stage` by x and u, and of `final`; what is empty comes from differences.
  MotionDerivative derivative{};
  std::function<MotionJacobians(const Eigen::VectorXd& x, const Eigen::VectorXd& u, int t)> stageDerivative{};
  std::function<Eigen::MatrixXd(const Eigen::VectorXd& x)> finalDerivative{};
};

struct IlqrOptions {
  int maxIterations = 100;
  double tolerance =
      1e-9;  ///< converged: the predicted decrease of a full step is less than this fraction of the cost
  double damping = 0;  ///< initial damping of the controls' weights; grows and falls by factors of ten
};

enum class IlqrStatus {
  kConverged,
  kBudgetSpent,
  kNoProgress,  ///< no step along the direction lowers the cost, with any damping
  kDiverged     ///< the first motion or its cost is not finite
};

/// The motion found, and the policy around it: u = U_t - K[t] (x - X_t).
struct IlqrResult {
  IlqrStatus status = IlqrStatus::kDiverged;
  Eigen::MatrixXd X{};  ///< n x (N + 1)
  Eigen::MatrixXd U{};  ///< m x N
  std::vector<Eigen::MatrixXd> K{};
  double cost = std::numeric_limits<double>::infinity();
  int iterations = 0;  ///< steps taken
  /// The predicted decrease of another step, relative to the cost.
  double residual = std::numeric_limits<double>::infinity();
  std::string message{};
};

/// Iterative LQR (Li and Todorov 2004): linearises around the motion, solves the linear quadratic problem
/// with Gauss-Newton matrices, and shortens the step until it lowers the cost. U is the initial guess, m x
/// N. Throws Error for a problem without functions, sizes that do not fit, numbers in start and U that are
/// not finite, derivatives of the wrong size or not finite, and options out of range.
[[nodiscard]] IlqrResult ilqr(const ControlProblem& problem, const Eigen::MatrixXd& U,
                              const IlqrOptions& options = {});

/// Controls for the first guess of a plan one step after `last`, from problem.start: those of its policy
/// without the first step, and the last one twice. The policy's feedback keeps the guess close to `last`
/// where the system is unstable. Throws Error for a start that does not fit, and if `last` has no policy.
[[nodiscard]] Eigen::MatrixXd followedPlan(const ControlProblem& problem, const IlqrResult& last);

}  // namespace rex
