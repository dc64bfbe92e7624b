#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

/// x' = A x + B u, y = C x + D u (slide 8:15); with a step, x_{t+1} = A x_t + B u_t. n states, m controls, p
/// measurements.
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

/// What the continuous system does in steps of `step` seconds while u is held: exact, by the exponential of
/// (A B; 0 0). Throws Error as completed(), for a step that is not positive, for a discrete system, and where
/// a motion grows beyond all numbers in one step.
[[nodiscard]] LinearSystem discretized(const LinearSystem& system, double step);

/// f(x, u): a rate of change, or the next state.
using ControlledMotion = std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& u)>;

/// df/dx and df/du.
struct MotionJacobians {
  Eigen::MatrixXd A, B;
};
using MotionDerivative = std::function<MotionJacobians(const Eigen::VectorXd& x, const Eigen::VectorXd& u)>;

/// f near (x, u), slide 8:16: f(x + dx, u + du) = value + A dx + B du. At an equilibrium of continuous time
/// the value is zero. Without `exact`, A and B are numericJacobian()s. Throws Error without f, and
/// where f or its derivatives have another size or are not finite.
struct Linearization {
  Eigen::MatrixXd A, B;
  Eigen::VectorXd value;
};
[[nodiscard]] Linearization linearized(const ControlledMotion& f, const Eigen::VectorXd& x,
                                       const Eigen::VectorXd& u, const MotionDerivative& exact = {});

}  // namespace rex
