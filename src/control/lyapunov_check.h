#pragma once

#include <functional>
#include <string>

#include <Eigen/Core>

#include "base/rng.h"
#include "base/vector_arg.h"

namespace rex {

enum class LyapunovStatus {
  kHolds,             ///< V is positive and falls, everywhere that was looked at but in the equilibrium
  kOnlySemidefinite,  ///< V never rises but does not fall everywhere: stable; use LaSalle's principle for
                      ///< more
  kNotPositive,       ///< V is not positive somewhere
  kRises              ///< V rises somewhere
};

/// What was found out about a candidate V, and the point that is worst for it.
struct LyapunovResult {
  LyapunovStatus status = LyapunovStatus::kRises;
  Eigen::VectorXd
      worst{};  ///< where V is least positive, if it is not; else where it rises most or falls least
  double V = 0, rate = 0;  ///< there; of V per second
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

/// Looks at V and its rate along x' = f(x) at random points of the region, at its corners and axes, and close
/// to the equilibrium, slide 8:40. Numbers relative to the squared distance count as zero below 1e-9. A
/// counterexample proves that V fails; without one V only may hold. Throws Error for a region that is empty
/// or does not hold its equilibrium, less than 1 sample, without functions or where they give other sizes or
/// numbers that are not finite, and for an equilibrium where f or V is not zero.
[[nodiscard]] LyapunovResult checkLyapunov(const std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>& f,
                                           const LyapunovCandidate& candidate, const LyapunovRegion& region,
                                           Rng& rng, int samples = 1000);

/// A proof for V = x^T P x along x' = A x, by eigenvalues: of P, and of A^T P + P A relative to P.
struct LyapunovCertificate {
  LyapunovStatus status = LyapunovStatus::kRises;
  double leastOfP = 0;  ///< eigenvalue
  /// V(t) <= e^{rate t} V(0); negative where V falls everywhere, and never below twice the spectral abscissa.
  double rate = 0;
  Eigen::VectorXd worst{};  ///< the direction in which P is least, if it is not positive; else of the rate
  std::string message{};
};
/// Throws Error for sizes, entries that are not finite, and a P that is not symmetric.
[[nodiscard]] LyapunovCertificate certifyQuadratic(const MatrixArg& A, const MatrixArg& P);

/// How far from zero V = x^T P x proves stability of x' = A x + g(x), |g(x)| <= curvature |x|^2: all motions
/// that start where V is below this level end at zero. 0 if the certificate of A and P does not hold. Throws
/// Error as certifyQuadratic(), and for a curvature that is not positive.
[[nodiscard]] double certifiedLevel(const MatrixArg& A, const MatrixArg& P, double curvature);

}  // namespace rex
