#pragma once

#include <complex>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/require.h"

namespace rex {

enum class Stability {
  kAsymptotic,  ///< all motions converge to zero
  kMarginal,    ///< none grows, some do not decay
  kUnstable     ///< some grow, exponentially or as a power of time
};

/// What the eigenvalues of A say about x' = A x or x_{t+1} = A x_t.
struct StabilityResult {
  Stability stability = Stability::kUnstable;
  Eigen::VectorXcd eigenvalues{};
  /// The largest real part (1/s), or the largest modulus: the decay rate of the slowest motion.
  double rate = 0;
  /// The eigenvalue that decides: one that grows, or that neither grows nor decays; else the slowest.
  std::complex<double> eigenvalue{};
  /// Its multiplicities. If the geometric one is smaller, powers of time appear.
  int algebraic = 1, geometric = 1;
  std::string message{};
};

/// Stability of x' = A x, slide 8:36. An eigenvalue on the imaginary axis is marginal only if it has as
/// many eigenvectors as its multiplicity: a double integrator is unstable. Eigenvalues count as on the axis
/// if rounding may have moved them off it. Throws Error unless A is square and finite.
[[nodiscard]] StabilityResult continuousStability(const MatrixArg& A);
/// Stability of x_{t+1} = A x_t, slide 8:38: the same with the unit circle.
[[nodiscard]] StabilityResult discreteStability(const MatrixArg& A);

}  // namespace rex
