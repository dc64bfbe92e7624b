#pragma once

#include "estimation/gaussian.h"
#include "estimation/gaussian_model.h"

namespace rex {

/// What an observation made of a belief.
struct KalmanUpdate {
  Gaussian belief{};
  Eigen::VectorXd innovation{};            ///< y - predicted observation
  Eigen::MatrixXd innovationCovariance{};  ///< of that
  double squaredInnovation = 0;  ///< in that metric: NIS, chi-square of y.size() degrees when consistent
  double logLikelihood = 0;      ///< log p(y | all observations before)
};

/// The belief after a transition: N(A s + a, A S A^T + Q). Slide 7:27. All filters here throw Error for
/// models as requireModel, beliefs that are no Gaussians of the model's size, observations that are not
/// finite or of another size, and an innovation whose covariance is singular, naming each.
[[nodiscard]] Gaussian kalmanPredict(const Gaussian& belief, const LinearModel& transition);
/// The belief given an observation: K = S C^T (W + C S C^T)^-1, s + K (y - C s - c), in Joseph's form, which
/// stays symmetric and semidefinite. Slide 7:27 with errata 10.
[[nodiscard]] KalmanUpdate kalmanUpdate(const Gaussian& predicted, const LinearModel& observation,
                                        const VectorArg& y);

/// The same in canonical form, where an observation only adds. The transition wants A and Q invertible.
[[nodiscard]] CanonicalGaussian informationPredict(const CanonicalGaussian& belief,
                                                   const LinearModel& transition);
/// Adds C^T W^-1 (y - c) and C^T W^-1 C; W must be definite.
[[nodiscard]] CanonicalGaussian informationUpdate(const CanonicalGaussian& predicted,
                                                  const LinearModel& observation, const VectorArg& y);

/// A Gaussian by a lower triangular root L of its covariance L L^T: half the digits suffice.
struct RootGaussian {
  Eigen::VectorXd mean{};
  Eigen::MatrixXd L{};
};
[[nodiscard]] RootGaussian toRoot(const Gaussian& x);
[[nodiscard]] Gaussian toNormal(const RootGaussian& x);
/// The Kalman filter on roots, by orthogonal transformations of arrays (Kaminski, Bryson and Schmidt 1971).
[[nodiscard]] RootGaussian rootPredict(const RootGaussian& belief, const LinearModel& transition);
[[nodiscard]] RootGaussian rootUpdate(const RootGaussian& predicted, const LinearModel& observation,
                                      const VectorArg& y);

/// The extended Kalman filter: models along their tangents at the mean. Slide 7:28.
[[nodiscard]] Gaussian extendedPredict(const Gaussian& belief, const NonlinearModel& transition);
[[nodiscard]] KalmanUpdate extendedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                                          const VectorArg& y);

/// Where the unscented transform puts its points, and how it weighs them: (alpha, beta, kappa) of Julier and
/// Uhlmann, and Wan and van der Merwe 2000. The points lie alpha sqrt(n + kappa) deviations away.
struct UnscentedOptions {
  double alpha = 1;  ///< at least 1e-6
  double beta = 2;   ///< 2 fits Gaussians
  double kappa = 0;  ///< > -n
};

/// The unscented Kalman filter: models at 2 n + 1 points, refitted by a Gaussian. Slide 7:28. Throws Error
/// for options out of range, too, and for those with which the fit is not a Gaussian.
[[nodiscard]] Gaussian unscentedPredict(const Gaussian& belief, const NonlinearModel& transition,
                                        const UnscentedOptions& options = {});
[[nodiscard]] KalmanUpdate unscentedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                                           const VectorArg& y, const UnscentedOptions& options = {});

}  // namespace rex
