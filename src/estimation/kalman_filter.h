#pragma once

#include <span>
#include <vector>

#include "estimation/gaussian.h"

namespace rex {

/// The result of updating a belief with an observation.
struct KalmanUpdate {
  Gaussian belief{};
  Eigen::VectorXd innovation{};            ///< y - predicted observation
  Eigen::MatrixXd innovationCovariance{};  ///< the covariance of the innovation
  double squaredInnovation = 0;  ///< NIS, in that metric: chi-square (y.size() degrees) if consistent
  double logLikelihood = 0;      ///< log p(y | all earlier observations)
};

/// The belief after a transition: N(A s + a, A S A^T + Q). Slide 7:27. All filters here throw Error like
/// requireModel, for beliefs that are not Gaussians of the model's size, observations that are not finite
/// or of the wrong size, and an innovation whose covariance is singular, naming each.
[[nodiscard]] Gaussian kalmanPredict(const Gaussian& belief, const LinearModel& transition);
/// The belief given an observation: K = S C^T (W + C S C^T)^-1, s + K (y - C s - c), in Joseph's form, which
/// stays symmetric and semidefinite. Slide 7:27 with erratum 14.
[[nodiscard]] KalmanUpdate kalmanUpdate(const Gaussian& predicted, const LinearModel& observation,
                                        const VectorArg& y);

/// The same in canonical form, where an update is a sum. A and Q of the transition must be invertible.
[[nodiscard]] CanonicalGaussian informationPredict(const CanonicalGaussian& belief,
                                                   const LinearModel& transition);
/// Adds C^T W^-1 (y - c) and C^T W^-1 C; W must be definite.
[[nodiscard]] CanonicalGaussian informationUpdate(const CanonicalGaussian& predicted,
                                                  const LinearModel& observation, const VectorArg& y);

/// A Gaussian with a lower triangular root L of its covariance L L^T: half the digits suffice.
struct RootGaussian {
  Eigen::VectorXd mean{};
  Eigen::MatrixXd L{};
};
[[nodiscard]] RootGaussian toRoot(const Gaussian& x);
[[nodiscard]] Gaussian toNormal(const RootGaussian& x);
/// The square root Kalman filter, by orthogonal transformations of arrays (Kaminski, Bryson and Schmidt
/// 1971).
[[nodiscard]] RootGaussian rootPredict(const RootGaussian& belief, const LinearModel& transition);
[[nodiscard]] RootGaussian rootUpdate(const RootGaussian& predicted, const LinearModel& observation,
                                      const VectorArg& y);

/// The extended Kalman filter: models linearised at the mean. Slide 7:28.
[[nodiscard]] Gaussian extendedPredict(const Gaussian& belief, const NonlinearModel& transition);
[[nodiscard]] KalmanUpdate extendedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                                          const VectorArg& y);

/// The points and weights of the unscented transform: (alpha, beta, kappa) of Julier and Uhlmann, and Wan
/// and van der Merwe 2000. The points are alpha sqrt(n + kappa) standard deviations from the mean.
struct UnscentedOptions {
  double alpha = 1;  ///< at least 1e-6
  double beta = 2;   ///< 2 is optimal for Gaussians
  double kappa = 0;  ///< > -n
};

/// The unscented Kalman filter: evaluates the models at 2 n + 1 points and fits a Gaussian. Slide 7:28.
/// Also throws Error for options out of range, and if the fitted covariance is not valid.
[[nodiscard]] Gaussian unscentedPredict(const Gaussian& belief, const NonlinearModel& transition,
                                        const UnscentedOptions& options = {});
[[nodiscard]] KalmanUpdate unscentedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                                           const VectorArg& y, const UnscentedOptions& options = {});

/// The beliefs of a Kalman filter, corrected by later observations: the smoother of Rauch, Tung and
/// Striebel (1965), which is slide 7:30 for Gaussians. transitions[t] leads from filtered[t] to filtered[t
/// + 1]; for an extended filter, pass the linearised models. Throws Error for counts and sizes that do not
/// fit, and like kalmanPredict.
[[nodiscard]] std::vector<Gaussian> smoothed(std::span<const Gaussian> filtered,
                                             std::span<const LinearModel> transitions);

}  // namespace rex
