#pragma once

#include "control/linear_system.h"
#include "control/riccati.h"

namespace rex {

/// The linear quadratic regulator u = -K x (slide 8:18; 8:43 has the opposite sign) that minimises int x^T
/// Q x + u^T R u, or its sum over all steps, among the controllers that stabilise the system. Uses
/// solveCare() or solveDare(). Throws Error like these, and for a Q with a negative eigenvalue.
[[nodiscard]] RiccatiResult lqr(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R);

/// The Kalman gain of x' = A x + B u + w, y = C x + D u + v, for noise with intensities W (n x n) and V (p
/// x p), from the equation of lqr() with A^T and C^T.
struct SteadyKalman {
  RiccatiStatus status = RiccatiStatus::kFailed;
  /// n x p: x^' = A x^ + B u + L (y - C x^ - D u); in discrete time x^_{t+1}, with y_t.
  Eigen::MatrixXd L{};
  Eigen::MatrixXd covariance{};   ///< of the error x - x^; in discrete time, of the prediction's error
  Eigen::VectorXcd closedLoop{};  ///< eigenvalues of A - L C
  std::string message{};          ///< names the mode that is not observable in y, or not excited by the noise
};
/// L and covariance are empty unless status is kSolved or kOnBoundary. Throws Error like lqr().
[[nodiscard]] SteadyKalman steadyKalman(const LinearSystem& system, const MatrixArg& W, const MatrixArg& V);

/// Regulator and Kalman filter, each optimal by itself; together they are the optimal controller that knows
/// only y.
struct Lqg {
  RiccatiStatus status = RiccatiStatus::kFailed;  ///< kSolved if both are solved
  RiccatiResult regulator{};
  SteadyKalman filter{};
  /// The system from y to u, whose state is the estimate x^: u = controller.C x^. Empty unless status is
  /// kSolved.
  LinearSystem controller{};
  std::string message{};
};
[[nodiscard]] Lqg lqg(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R, const MatrixArg& W,
                      const MatrixArg& V);

/// The closed loop of both systems, u = controller(y), with states (x, x^). The controller's D must be 0.
/// Throws Error for sizes and steps that do not fit.
[[nodiscard]] LinearSystem closedLoop(const LinearSystem& system, const LinearSystem& controller);

/// An equilibrium with y = target: 0 = A x + B u (or x = A x + B u), C x + D u = target. The control u_rest
/// - K (x - x_rest) holds the system there. `isExact` is false if there is no such equilibrium; x and u are
/// then the minimum-norm least-squares solution. Throws Error for sizes that do not fit.
struct RestPoint {
  Eigen::VectorXd x{}, u{};
  bool isExact = false;
};
[[nodiscard]] RestPoint restPoint(const LinearSystem& system, const VectorArg& target);

}  // namespace rex
