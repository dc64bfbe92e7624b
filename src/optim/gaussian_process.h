#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "base/require.h"

namespace rex {

/// Covariances of f at two points whose difference, divided by the lengths, has the norm r.
enum class GaussianKernel {
  kSquaredExponential,  ///< exp(-r^2 / 2): f has all derivatives
  kMatern52             ///< (1 + sqrt(5) r + 5/3 r^2) exp(-sqrt(5) r): f has two
};

/// Hyper-parameters of a Gaussian process over functions f of d variables.
struct GaussianProcessParameters {
  double mean = 0;            ///< of f, everywhere
  double deviation = 1;       ///< of f around its mean, standard
  Eigen::VectorXd lengths{};  ///< d: how far f keeps its value along each coordinate
  double noise = 0;           ///< standard deviation of observations around f
};

/// f at a point: normally distributed, given all observations.
struct GaussianPrediction {
  double mean = 0, deviation = 0;
  Eigen::VectorXd meanGradient{}, deviationGradient{};  ///< d
};

/// A function f from noisy values at n points: regression with a Gaussian process (Rasmussen and
/// Williams, 2006, chapters 2, 4 and 5). Where f is exact, 1e-5 deviations of noise make it computable.
class GaussianProcess {
 public:
  /// X is d x n, one point per column; y has n values. Throws Error without points, for sizes that do not
  /// fit, numbers that are not finite or not positive, and covariances that cannot be factored.
  GaussianProcess(Eigen::MatrixXd X, Eigen::VectorXd y, GaussianProcessParameters parameters,
                  GaussianKernel kernel = GaussianKernel::kMatern52);

  /// Throws Error for an x of the wrong size.
  [[nodiscard]] GaussianPrediction predict(const VectorArg& x) const;
  /// log p(y | X), the marginal likelihood, and its derivatives with respect to the mean and the logarithms
  /// of deviation, lengths (d) and noise.
  [[nodiscard]] double logLikelihood() const;
  [[nodiscard]] Eigen::VectorXd logLikelihoodGradient() const;

  [[nodiscard]] const Eigen::MatrixXd& points() const { return X_; }
  [[nodiscard]] const Eigen::VectorXd& values() const { return y_; }
  [[nodiscard]] const GaussianProcessParameters& parameters() const { return parameters_; }

 private:
  Eigen::MatrixXd X_;
  Eigen::VectorXd y_, alpha_;  // alpha: K^-1 (y - mean)
  GaussianProcessParameters parameters_;
  GaussianKernel kernel_;
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

struct GaussianFitOptions {
  GaussianKernel kernel = GaussianKernel::kMatern52;
  bool isNoisy = false;                        ///< otherwise observations are exact
  double leastLength = 0.05, mostLength = 10;  ///< of f, in widths of the points along that coordinate
  GaussianProcessParameters start{};           ///< begins there; without lengths, at those of a third
};

/// The process of greatest marginal likelihood, a local maximum: mean and deviation in closed form, lengths
/// and noise by their gradient. Noise is between 1e-4 and 1 deviations. Throws Error as the process does, and
/// for options out of range.
[[nodiscard]] GaussianProcess fittedGaussianProcess(const MatrixArg& X, const VectorArg& y,
                                                    const GaussianFitOptions& options = {});

}  // namespace rex
