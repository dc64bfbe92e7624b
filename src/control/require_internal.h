#pragma once

#include <cmath>
#include <complex>
#include <string>

#include <fmt/format.h>

#include "base/require.h"
#include "control/pid.h"
#include "scene/state.h"

namespace rex::internal {

inline std::string eigenvalueText(std::complex<double> value) {
  const double real = value.real() + 0.;  // no -0
  return std::abs(value.imag()) < 1e-300 ? fmt::format("{:.6g}", real)
                                         : fmt::format("{:.6g}{:+.6g}i", real, value.imag());
}

/// Throws Error "matrix NAME: found entries that are not finite".
void requireFiniteMatrix(const std::string& name, const MatrixArg& M);

/// M without what rounding made unequal in its two halves.
Eigen::MatrixXd symmetricPart(const MatrixArg& M);

/// Throws Error, naming it, unless M is n x n, finite and symmetric.
void requireSymmetric(const std::string& name, const MatrixArg& M, Eigen::Index n);

/// Throws Error with the least eigenvalue unless a symmetric M is positive definite beyond rounding, whatever
/// the units of its rows.
void requirePositiveDefinite(const std::string& name, const MatrixArg& M);

inline void requireFinite(const PdGains& gains) {
  rex::requireFinite("gain Kp", gains.Kp);
  rex::requireFinite("gain Kd", gains.Kd);
}

inline void requireFinite(const State& state) {
  rex::requireFinite("joint positions q", state.q);
  rex::requireFinite("joint velocities v", state.v);
}

}  // namespace rex::internal
