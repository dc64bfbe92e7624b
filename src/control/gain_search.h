#pragma once

#include <string>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

struct GainSearchOptions {
  double bound = 100;  ///< on the entries of K; without it the fastest gains of most systems are infinite
  int maxEvaluations = 20000;
  double tolerance = 1e-9;  ///< converged: restarts improve the rate by less than this fraction
};

struct GainSearchResult {
  bool isConverged = false;
  Eigen::MatrixXd K{};  ///< m x p: u = -K y
  /// Largest real part (1/s), or largest modulus, of the eigenvalues of A - B K C.
  double rate = 0;
  bool isStable = false;  ///< asymptotically
  int evaluations = 0;
  std::string message{};
};

/// The output feedback u = -K y with the fastest asymptotic convergence, slide 8:39: a local minimum of
/// `rate`, found by the simplex method of Nelder and Mead (1965). The method is restarted where it stops,
/// because it stalls at kinks of the rate. Throws Error like completed(), for a system without a control, a
/// D that is not zero, a start of the wrong size or out of bounds, and options out of range.
[[nodiscard]] GainSearchResult fastestGains(const LinearSystem& system, const Eigen::MatrixXd& start,
                                            const GainSearchOptions& options = {});

}  // namespace rex
