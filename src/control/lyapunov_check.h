#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

#include "base/require.h"
#include "base/rng.h"

namespace rex {

enum class LyapunovStatus {
  kHolds,             ///< V is positive and decreasing at all sampled points except the equilibrium
  kOnlySemidefinite,  ///< V never increases but does not decrease everywhere: stable; use LaSalle's
                      ///< principle for more
  kNotPositive,       ///< V is not positive somewhere
  kRises              ///< V increases somewhere
};

/// The verdict on a candidate V, and the worst point for it.
struct LyapunovResult {
  LyapunovStatus status = LyapunovStatus::kRises;
  Eigen::VectorXd worst{};  ///< where V is smallest, if it is not positive; else where its rate is largest
  double V = 0, rate = 0;   ///< at the worst point; the rate is V's change per second
  int samples = 0;
  std::string message{};
};

struct LyapunovCandidate {
  std::function<double(const Eigen::VectorXd& x)> V{};
  std::function<Eigen::VectorXd(const Eigen::VectorXd& x)> gradient{};  ///< empty: by differences
};

/// The box low <= x <= high around the equilibrium.
struct LyapunovRegion {
  Eigen::VectorXd low{}, high{}, equilibrium{};
};

/// Evaluates V and its rate along x' = f(x) at random points of the region, on its corners and axes, and
/// near the equilibrium (slide 8:40). Values below 1e-9 of the squared distance count as zero. A
/// counterexample disproves V; without one V may still fail elsewhere. Throws Error for a region that is
/// empty or does not contain the equilibrium, fewer than 1 sample, functions that are missing or return
/// wrong sizes or values that are not finite, and an equilibrium where f or V is not zero.
[[nodiscard]] LyapunovResult checkLyapunov(const std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>& f,
                                           const LyapunovCandidate& candidate, const LyapunovRegion& region,
                                           Rng& rng, int samples = 1000);

/// A proof for V = x^T P x along x' = A x from the eigenvalues of P, and of A^T P + P A relative to P.
struct LyapunovCertificate {
  LyapunovStatus status = LyapunovStatus::kRises;
  double leastOfP = 0;  ///< smallest eigenvalue of P
  /// V(t) <= e^{rate t} V(0). Negative if V decreases everywhere; never below twice the spectral abscissa.
  double rate = 0;
  Eigen::VectorXd worst{};  ///< direction of the least eigenvalue of P, if not positive; else of the rate
  std::string message{};
};
/// Throws Error for sizes that do not fit, entries that are not finite, and a P that is not symmetric.
[[nodiscard]] LyapunovCertificate certifyQuadratic(const MatrixArg& A, const MatrixArg& P);

/// The level of V = x^T P x up to which it proves stability of x' = A x + g(x) with |g(x)| <= curvature
/// |x|^2: all motions that start with V below this level converge to zero. Returns 0 if the certificate of
/// A and P does not hold. Throws Error like certifyQuadratic(), and for a curvature that is not positive.
[[nodiscard]] double certifiedLevel(const MatrixArg& A, const MatrixArg& P, double curvature);

}  // namespace rex
