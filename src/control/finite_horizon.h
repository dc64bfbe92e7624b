#pragma once

#include <limits>
#include <string>
#include <vector>

#include "control/linear_system.h"
#include "control/riccati.h"

namespace rex {

/// The Riccati equation of a finite horizon, slide 8:19: x^T P[i] x is the least cost from time i on, and
/// u = -K[i] x costs no more.
struct RiccatiHorizon {
  /// False: P grew without bound, R + B^T P B was not positive definite, or it would take too long.
  bool isSolved = false;
  std::vector<Eigen::MatrixXd> P{};  ///< at times 0 to N; empty unless isSolved
  std::vector<Eigen::MatrixXd> K{};  ///< discrete: of steps 0 to N - 1; continuous: at times 0 to N
  std::string message{};
};

/// P_{t-1} = Q + A^T (P_t - P_t B (R + B^T P_t B)^-1 B^T P_t) A, P_N = F. Throws Error for fewer than 1 or
/// more than 10^7 steps, a system of continuous time, sizes, entries that are not finite or not symmetric.
[[nodiscard]] RiccatiHorizon discreteHorizon(const LinearSystem& system, const MatrixArg& Q,
                                             const MatrixArg& R, const MatrixArg& F, int steps);

/// -P' = A^T P + P A - P B R^-1 B^T P + Q, P(T) = F, at `steps` + 1 times from 0 to T. Exact between them, by
/// the exponential of the Hamiltonian matrix. Throws Error as discreteHorizon(), for a system of discrete
/// time, a T that is not positive and an R that is not positive definite.
[[nodiscard]] RiccatiHorizon continuousHorizon(const LinearSystem& system, const MatrixArg& Q,
                                               const MatrixArg& R, const MatrixArg& F, double T, int steps);

struct RiccatiIterationOptions {
  double epsilon = 1e-3;     ///< seconds of backward time per iteration
  double tolerance = 1e-10;  ///< of the change per second: the residual of the algebraic equation
  int maxIterations = 1000000;
};
struct RiccatiIteration {
  bool isConverged = false;
  Eigen::MatrixXd P{}, K{};  ///< the last ones
  int iterations = 0;
  double residual = std::numeric_limits<double>::infinity();  ///< largest entry
  std::string message{};
};
/// The algebraic equation by explicit Euler steps of the differential one, from P = Q: P += epsilon (A^T P +
/// P A - P B R^-1 B^T P + Q), as exercise 11b asks. Slow, and too large steps diverge: solveCare() is the
/// way, this is what it can be compared with. Throws Error as continuousHorizon(), and for options out of
/// range.
[[nodiscard]] RiccatiIteration iterateCare(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R,
                                           const RiccatiIterationOptions& options = {});

}  // namespace rex
