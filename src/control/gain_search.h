#pragma once

#include <string>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

struct GainSearchOptions {
  double bound = 100;  ///< no entry of K is larger: without it the fastest gains of most systems are infinite
  int maxEvaluations = 20000;
  double tolerance = 1e-9;  ///< converged: restarts improve the rate by less than this part of it
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

/// The controller of fastest asymptotic convergence, slide 8:39, that knows only y = C x: gains whose slowest
/// closed-loop eigenvalue is least, by the simplex of Nelder and Mead (1965), restarted where it stops,
/// because the best rate has edges on which it stalls. A local optimum. Throws Error as completed(), without
/// a control, for a D that is not zero, a start of another size or out of bounds, and options out of range.
[[nodiscard]] GainSearchResult fastestGains(const LinearSystem& system, const Eigen::MatrixXd& start,
                                            const GainSearchOptions& options = {});

}  // namespace rex
