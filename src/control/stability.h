#pragma once

#include <complex>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "base/vector_arg.h"

namespace rex {

enum class Stability {
  kAsymptotic,  ///< all motions end at zero
  kMarginal,    ///< none grows, some do not end
  kUnstable     ///< some grow: exponentially, or as a power of time
};

/// What the eigenvalues of A tell of x' = A x or x_{t+1} = A x_t.
struct StabilityResult {
  Stability stability = Stability::kUnstable;
  Eigen::VectorXcd eigenvalues{};
  /// The largest real part (1/s), or the largest modulus: how the slowest motion decays.
  double rate = 0;
  /// The eigenvalue that decides: the one that grows, or that neither grows nor decays; else the slowest.
  std::complex<double> eigenvalue{};
  /// So many directions belong to it, and so many of them are eigenvectors; fewer: powers of time appear.
  int algebraic = 1, geometric = 1;
  std::string message{};
};

/// Of x' = A x, slide 8:36. Eigenvalues on the imaginary axis are marginal only where they have as many
/// eigenvectors as their multiplicity: a double integrator is unstable. An eigenvalue counts as on the axis
/// when rounding may have moved it from there. Throws Error unless A is square and finite.
[[nodiscard]] StabilityResult stabilityOf(const MatrixArg& A);
/// Of x_{t+1} = A x_t, slide 8:38: the same with the unit circle.
[[nodiscard]] StabilityResult discreteStabilityOf(const MatrixArg& A);

}  // namespace rex
