#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

/// A mode that u cannot reach: left^T A = eigenvalue left^T and left^T B = 0, so that left^T x moves by
/// itself.
struct HiddenMode {
  std::complex<double> eigenvalue{};
  Eigen::VectorXcd direction{};  ///< `left`, of length one; of observability: the motion that y does not show
};

/// Which states u can reach, or y shows. Of observability read: which initial states y tells apart.
struct ReachableStates {
  int rank = 0;
  Eigen::MatrixXd reachable{};      ///< n x rank, orthonormal
  Eigen::MatrixXd unreachable{};    ///< n x (n - rank), orthonormal: what is never moved, or never seen
  std::vector<HiddenMode> modes{};  ///< n - rank of them
  /// Full rank. The message names the modes that are hidden.
  bool isComplete = false;
  std::string message{};
};

/// (B, A B, ..., A^{n-1} B), n x n m, slide 8:27. Good for reading; powers lose digits, so that
/// controllability() does not use it. Throws Error as completed().
[[nodiscard]] Eigen::MatrixXd controllabilityMatrix(const LinearSystem& system);
/// (C; C A; ...; C A^{n-1}), n p x n, slide 8:44. Throws Error as completed().
[[nodiscard]] Eigen::MatrixXd observabilityMatrix(const LinearSystem& system);

/// By an orthogonal staircase form (Van Dooren 1981). Directions count as reached when more than `tolerance`
/// of the largest entry of A, or of the control's column, arrives there. Throws Error as completed(), and for
/// a tolerance that is not in (0, 1).
[[nodiscard]] ReachableStates controllability(const LinearSystem& system, double tolerance = 1e-12);
/// The same of A^T and C^T.
[[nodiscard]] ReachableStates observability(const LinearSystem& system, double tolerance = 1e-12);

/// W = int_0^T e^{A s} B B^T e^{A^T s} ds, or the sum of T / step terms: x^T W^-1 x is the least u^T u that
/// leads from 0 to x. Throws Error as completed(), for a T that is not positive or more than 1e15 steps, and
/// where W is not finite.
[[nodiscard]] Eigen::MatrixXd controllabilityGramian(const LinearSystem& system, double T);
/// The limit of long times, by a Lyapunov equation. Throws Error where the system is not asymptotically
/// stable, naming the mode.
[[nodiscard]] Eigen::MatrixXd controllabilityGramian(const LinearSystem& system);
/// The same of A^T and C^T: x^T W x is what y^T y sums up to from x on, with u = 0.
[[nodiscard]] Eigen::MatrixXd observabilityGramian(const LinearSystem& system, double T);
[[nodiscard]] Eigen::MatrixXd observabilityGramian(const LinearSystem& system);

}  // namespace rex
