#pragma once

#include <complex>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

/// A mode that u cannot reach: left^T A = eigenvalue left^T and left^T B = 0, so left^T x evolves
/// independently of u.
struct HiddenMode {
  std::complex<double> eigenvalue{};
  Eigen::VectorXcd
      direction{};  ///< `left`, of unit length; for observability: the motion that y does not show
};

/// Which states u can reach; for observability, which initial states y can distinguish.
struct ReachableStates {
  int rank = 0;
  Eigen::MatrixXd reachable{};      ///< n x rank, orthonormal
  Eigen::MatrixXd unreachable{};    ///< n x (n - rank), orthonormal: never moved, or never seen
  std::vector<HiddenMode> modes{};  ///< n - rank of them
  /// Whether the rank is full. If not, the message names the hidden modes.
  bool isComplete = false;
  std::string message{};
};

/// (B, A B, ..., A^{n-1} B), n x n m, slide 8:27. For illustration only: powers of A lose digits, so
/// controllability() does not use it. Throws Error like completed().
[[nodiscard]] Eigen::MatrixXd controllabilityMatrix(const LinearSystem& system);
/// (C; C A; ...; C A^{n-1}), n p x n, slide 8:44. Throws Error like completed().
[[nodiscard]] Eigen::MatrixXd observabilityMatrix(const LinearSystem& system);

/// Uses an orthogonal staircase form (Van Dooren 1981). A direction counts as reachable if the coupling
/// into it exceeds `tolerance` times the largest entry of A, or of the control's column. Throws Error like
/// completed(), and for a tolerance outside (0, 1).
[[nodiscard]] ReachableStates controllability(const LinearSystem& system, double tolerance = 1e-12);
/// The same for A^T and C^T.
[[nodiscard]] ReachableStates observability(const LinearSystem& system, double tolerance = 1e-12);

/// W = int_0^T e^{A s} B B^T e^{A^T s} ds, or the sum of T / step terms: x^T W^-1 x is the minimal integral
/// of u^T u that leads from 0 to x. Throws Error like completed(), for a T that is not positive or takes
/// more than 1e15 steps, and if W is not finite.
[[nodiscard]] Eigen::MatrixXd controllabilityGramian(const LinearSystem& system, double T);
/// The limit for T -> infinity, from a Lyapunov equation. Throws Error naming the mode if the system is not
/// asymptotically stable.
[[nodiscard]] Eigen::MatrixXd controllabilityGramian(const LinearSystem& system);
/// The same for A^T and C^T: x^T W x is the integral of y^T y from the initial state x on, with u = 0.
[[nodiscard]] Eigen::MatrixXd observabilityGramian(const LinearSystem& system, double T);
[[nodiscard]] Eigen::MatrixXd observabilityGramian(const LinearSystem& system);

}  // namespace rex
