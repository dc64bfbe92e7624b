#pragma once

#include <complex>
#include <limits>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

enum class RiccatiStatus {
  kSolved,
  kNotStabilizable,  ///< a mode that does not decay cannot be reached by u
  kNotDetectable,    ///< a mode that neither grows nor decays costs nothing
  kOnBoundary,  ///< closed-loop eigenvalues on the imaginary axis or unit circle: X is the limit, accurate
                ///< to half the digits
  kFailed       ///< no solution, or none computable in double precision
};

/// A solution of an algebraic Riccati equation. X and K are empty unless status is kSolved or kOnBoundary.
struct RiccatiResult {
  RiccatiStatus status = RiccatiStatus::kFailed;
  Eigen::MatrixXd X{};            ///< symmetric, n x n
  Eigen::MatrixXd K{};            ///< m x n: u = -K x
  Eigen::VectorXcd closedLoop{};  ///< eigenvalues of A - B K
  /// The norm of the equation's residual, relative to its largest term.
  double residual = std::numeric_limits<double>::infinity();
  /// The offending eigenvalue. It belongs to A if a mode is not stabilizable or detectable (also with
  /// kSolved, if X stabilizes an unobservable growing mode), and to the equation's pencil if it lies on the
  /// axis or circle.
  std::optional<std::complex<double>> mode{};
  std::string message{};
};

/// Solves 0 = A^T X + X A - X B R^-1 B^T X + Q for the X that makes A - B K stable, K = R^-1 B^T X. Slide
/// 8:19, algebraic and continuous. Uses the ordered Schur form of a balanced extended pencil (Van Dooren
/// 1981), then Newton steps with residuals in extended precision. Throws Error for sizes that do not fit,
/// entries that are not finite, Q or R that are not symmetric, and an R that is not positive definite,
/// naming each. Q may be indefinite; then a solution need not exist. X is the minimal cost if every growing
/// mode is observable.
[[nodiscard]] RiccatiResult solveCare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q,
                                      const MatrixArg& R);

/// Solves X = A^T X A - A^T X B (R + B^T X B)^-1 B^T X A + Q, K = (R + B^T X B)^-1 B^T X A. Slide 8:19,
/// algebraic and discrete. R may be singular as long as R + B^T X B is not. Otherwise like solveCare.
[[nodiscard]] RiccatiResult solveDare(const MatrixArg& A, const MatrixArg& B, const MatrixArg& Q,
                                      const MatrixArg& R);

/// The symmetric X of A^T X + X A + Q = 0. Throws Error for sizes that do not fit, entries that are not
/// finite, and if two eigenvalues of A sum to zero.
[[nodiscard]] Eigen::MatrixXd solveLyapunov(const MatrixArg& A, const MatrixArg& Q);
/// The symmetric X of A^T X A - X + Q = 0. Throws like solveLyapunov, but if the product of two eigenvalues
/// is one.
[[nodiscard]] Eigen::MatrixXd solveDiscreteLyapunov(const MatrixArg& A, const MatrixArg& Q);

}  // namespace rex
