#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// x' = A x + B u, y = C x + D u (slide 8:15); or, with a step, x_{t+1} = A x_t + B u_t. n states, m
/// controls, p measurements.
struct LinearSystem {
  Eigen::MatrixXd A{};           ///< n x n
  Eigen::MatrixXd B{};           ///< n x m
  Eigen::MatrixXd C{};           ///< p x n; empty: y is x
  Eigen::MatrixXd D{};           ///< p x m; empty: 0
  std::optional<double> step{};  ///< seconds; empty: continuous time
};

/// The same with C and D filled in. Throws Error for sizes that do not fit, entries that are not finite, and
/// a step that is not positive.
[[nodiscard]] LinearSystem completed(const LinearSystem& system);

/// Discretizes a continuous system for steps of `step` seconds in which u is held. Exact, by the
/// exponential of (A B; 0 0). Throws Error like completed(), for a step that is not positive, for a
/// discrete system, and if a motion overflows within one step.
[[nodiscard]] LinearSystem discretized(const LinearSystem& system, double step);

/// f(x, u): a rate of change, or the next state.
using ControlledMotion = std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& u)>;

/// df/dx and df/du.
struct MotionJacobians {
  Eigen::MatrixXd A, B;
};
using MotionDerivative = std::function<MotionJacobians(const Eigen::VectorXd& x, const Eigen::VectorXd& u)>;

/// f near (x, u), slide 8:16: f(x + dx, u + du) = value + A dx + B du. At an equilibrium in continuous time
/// the value is zero. Without `exact`, A and B come from numericJacobian(). Throws Error if f is empty, and
/// if f or its derivatives have the wrong size or are not finite.
struct Linearization {
  Eigen::MatrixXd A, B;
  Eigen::VectorXd value;
};
[[nodiscard]] Linearization linearized(const ControlledMotion& f, const Eigen::VectorXd& x,
                                       const Eigen::VectorXd& u, const MotionDerivative& exact = {});

}  // namespace rex
