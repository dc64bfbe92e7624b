#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"
#include "control/riccati.h"

namespace rex {

/// The Riccati equation with a finite horizon, slide 8:19: x^T P[i] x is the optimal cost from time i on,
/// and u = -K[i] x attains it.
struct RiccatiHorizon {
  /// False: P grew without bound, R + B^T P B was not positive definite, or it would take too long.
  bool isSolved = false;
  std::vector<Eigen::MatrixXd> P{};  ///< at times 0 to N; empty unless isSolved
  std::vector<Eigen::MatrixXd> K{};  ///< discrete: for steps 0 to N - 1; continuous: at times 0 to N
  std::string message{};
};

/// P_{t-1} = Q + A^T (P_t - P_t B (R + B^T P_t B)^-1 B^T P_t) A, P_N = F. Throws Error for fewer than 1 or
/// more than 10^7 steps, a continuous-time system, sizes that do not fit, entries that are not finite, and
/// weights that are not symmetric.
[[nodiscard]] RiccatiHorizon discreteHorizon(const LinearSystem& system, const MatrixArg& Q,
                                             const MatrixArg& R, const MatrixArg& F, int steps);

/// -P' = A^T P + P A - P B R^-1 B^T P + Q, P(T) = F, at `steps` + 1 times from 0 to T. The integration is
/// exact, by the exponential of the Hamiltonian matrix. Throws Error like discreteHorizon(), for a
/// discrete-time system, a T that is not positive and an R that is not positive definite.
[[nodiscard]] RiccatiHorizon continuousHorizon(const LinearSystem& system, const MatrixArg& Q,
                                               const MatrixArg& R, const MatrixArg& F, double T, int steps);

struct RiccatiIterationOptions {
  double epsilon = 1e-3;     ///< seconds of backward time per iteration
  double tolerance = 1e-10;  ///< for the change of P per second, the residual of the algebraic equation
  int maxIterations = 1000000;
};
struct RiccatiIteration {
  bool isConverged = false;
  Eigen::MatrixXd P{}, K{};  ///< the last ones
  int iterations = 0;
  double residual = std::numeric_limits<double>::infinity();  ///< largest entry
  std::string message{};
};
/// Solves the algebraic equation with explicit Euler steps of the differential one, from P = Q: P +=
/// epsilon (A^T P + P A - P B R^-1 B^T P + Q), as in sheet 12.11.1 b. It is slow, and diverges for large
/// steps. Use solveCare() instead, except for comparison. Throws Error like continuousHorizon(), and for
/// options out of range.
[[nodiscard]] RiccatiIteration iterateCare(const LinearSystem& system, const MatrixArg& Q, const MatrixArg& R,
                                           const RiccatiIterationOptions& options = {});

/// One step of a time-varying linear quadratic problem, such as a linearisation or the tracking of a path:
/// x_{t+1} = A x + B u + c, with the cost x^T Q x + u^T R u + 2 u^T S x + 2 q^T x + 2 r^T u.
struct LqStage {
  Eigen::MatrixXd A{};  ///< n x n
  Eigen::MatrixXd B{};  ///< n x m
  Eigen::VectorXd c{};  ///< empty: 0; the same for all below
  Eigen::MatrixXd Q{};  ///< n x n
  Eigen::MatrixXd R{};  ///< m x m
  Eigen::MatrixXd S{};  ///< m x n
  Eigen::VectorXd q{};
  Eigen::VectorXd r{};
};

/// The policy u_t = k[t] - K[t] x_t and its cost-to-go.
struct LqPolicy {
  bool isSolved = false;             ///< false: the cost of some control has no minimum
  std::vector<Eigen::MatrixXd> K{};  ///< for steps 0 to N - 1
  std::vector<Eigen::VectorXd> k{};
  std::vector<Eigen::MatrixXd> P{};  ///< cost from t on: x^T P x + 2 p^T x + constant; for times 0 to N
  std::vector<Eigen::VectorXd> p{};
  int stage = -1;  ///< the stage that failed
  std::string message{};
};

/// Solves Bellman's equation backward from x^T F x + 2 f^T x (slide 8:14). `damping` is added to the
/// diagonal of each control's weight. Only the symmetric parts of Q, R and F are used. Throws Error for
/// sizes that do not fit and entries that are not finite, naming the stage, if there are no stages, and for
/// a negative damping.
[[nodiscard]] LqPolicy solveLq(const std::vector<LqStage>& stages, const Eigen::MatrixXd& F,
                               const Eigen::VectorXd& f, double damping = 0);

/// The stages for tracking `path` (N + 1 states r_t, one per column) with a constant system at the cost sum
/// (x_t - r_t)^T Q (x_t - r_t) + u_t^T R u_t (slide 8:13). The last column is for the final cost, with f =
/// -F r_N. Throws Error if the sizes of the path or Q do not fit A.
[[nodiscard]] std::vector<LqStage> trackingStages(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                                                  const Eigen::MatrixXd& Q, const Eigen::MatrixXd& R,
                                                  const Eigen::MatrixXd& path);

}  // namespace rex
