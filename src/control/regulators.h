#pragma once

#include "control/linear_system.h"
#include "control/riccati.h"

namespace rex {

/// The linear quadratic regulator u = -K x (slide 8:18; 8:43 has the other sign) of least
/// int x^T Q x + u^T R u, or the sum of that over all steps, among those that end at rest: solveCare() or
/// solveDare(). Throws Error as they do, and for a Q with a negative eigenvalue.
[[nodiscard]] RiccatiResult lqr(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R);

/// The Kalman gain of x' = A x + B u + w, y = C x + D u + v, for noise of intensities W (n x n) and V (p x
/// p), by the equation of lqr() for A^T and C^T.
struct SteadyKalman {
  RiccatiStatus status = RiccatiStatus::kFailed;
  /// n x p: x^' = A x^ + B u + L (y - C x^ - D u); in discrete time x^_{t+1}, with y_t.
  Eigen::MatrixXd L{};
  Eigen::MatrixXd covariance{};   ///< of x - x^; in discrete time, of the prediction
  Eigen::VectorXcd closedLoop{};  ///< eigenvalues of A - L C
  std::string message{};          ///< names the mode that y does not show, or that the noise does not move
};
/// L and covariance are empty unless status is kSolved or kOnBoundary. Throws Error as lqr().
[[nodiscard]] SteadyKalman steadyKalman(const LinearSystem& system, const MatrixArg& W, const MatrixArg& V);

/// Regulator and Kalman filter, each the best by itself: together the best control that knows only y.
struct Lqg {
  RiccatiStatus status = RiccatiStatus::kFailed;  ///< kSolved if both are
  RiccatiResult regulator{};
  SteadyKalman filter{};
  /// From y to u, its state is the estimate x^: u = controller.C x^. Empty unless status is kSolved.
  LinearSystem controller{};
  std::string message{};
};
[[nodiscard]] Lqg lqg(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R, const MatrixArg& W,
                      const MatrixArg& V);

/// Both systems in a ring: u = controller(y), whose D is 0. States (x, x^). Throws Error for sizes and
/// steps that do not fit.
[[nodiscard]] LinearSystem closedLoop(const LinearSystem& system, const LinearSystem& controller);

/// Where the system rests with y = target: 0 = A x + B u (or x = A x + B u), C x + D u = target. Then
/// u_rest - K (x - x_rest) holds it there. `isExact` is false where no rest has that y: x and u are then the
/// nearest by least squares, of several the shortest. Throws Error for sizes.
struct RestPoint {
  Eigen::VectorXd x{}, u{};
  bool isExact = false;
};
[[nodiscard]] RestPoint restAt(const LinearSystem& system, const VectorArg& target);

}  // namespace rex
