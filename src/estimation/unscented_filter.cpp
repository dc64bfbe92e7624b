#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"
#include "estimation/kalman_filter.h"

namespace rex {
namespace {

// Points around a mean, and the values of a model there.
struct Spread {
  Eigen::MatrixXd offsets{};  // n x (2 n + 1), from the mean
  Eigen::MatrixXd values{};   // m x (2 n + 1), as differences from the value at the mean
  Eigen::VectorXd center{};   // that value
  Eigen::VectorXd meanWeights{}, covarianceWeights{};
};

void requireOptions(const UnscentedOptions& options, double n) {
  requireFinite("unscented transform: beta", options.beta);
  if (!(options.alpha >= 1e-6) || !std::isfinite(options.alpha)) {
    throw Error({.what = "unscented transform: alpha",
                 .found = fmt::format("{:g}", options.alpha),
                 .wanted = "at least 1e-6"});
  }
  if (!(options.kappa > -n) || !std::isfinite(options.kappa)) {
    throw Error({.what = "unscented transform: kappa",
                 .found = fmt::format("{:g}", options.kappa),
                 .wanted = fmt::format("more than {}", -n)});
  }
}

Spread spread(const Gaussian& belief, const NonlinearModel& model, const UnscentedOptions& options) {
  internal::requireBelief(belief);
  if (!model.g) throw Error({.what = "model", .found = "no function g"});
  const Eigen::Index n = belief.mean.size(), count = 2 * n + 1;
  const double size = static_cast<double>(n);
  requireOptions(options, size);
  const double scale = options.alpha * options.alpha * (size + options.kappa);  // n + lambda
  Spread result;
  const Eigen::MatrixXd root = std::sqrt(scale) * covarianceRoot(belief.covariance);
  result.offsets.setZero(n, count);
  result.offsets.middleCols(1, n) = root;
  result.offsets.rightCols(n) = -root;
  result.center = model.g(belief.mean);
  requireFinite("value of the model", result.center);
  requireCovariance("model: covariance of the noise", model.W, result.center.size());
  result.values.setZero(result.center.size(), count);
  for (Eigen::Index i = 1; i < count; ++i) {
    const Eigen::VectorXd value = model.g(belief.mean + result.offsets.col(i));
    requireSize("value of the model", value.size(), result.center.size());
    requireFinite("value of the model", value);
    result.values.col(i) = difference(model, value, result.center);
  }
  result.meanWeights.setConstant(count, 0.5 / scale);
  result.meanWeights[0] = 1 - size / scale;
  result.covarianceWeights = result.meanWeights;
  result.covarianceWeights[0] += 1 - options.alpha * options.alpha + options.beta;
  return result;
}

// Mean of the values from the center, then values from that mean; returns the mean.
Eigen::VectorXd centred(Spread& points) {
  const Eigen::VectorXd mean = points.values * points.meanWeights;
  points.values.colwise() -= mean;
  return mean;
}

Eigen::MatrixXd covarianceOf(const Spread& points, const Eigen::MatrixXd& noise) {
  const Eigen::MatrixXd covariance =
      symmetrized(points.values * points.covarianceWeights.asDiagonal() * points.values.transpose() + noise);
  // A negative weight of the middle can outweigh all others.
  requireCovariance("unscented transform with these options: covariance", covariance, covariance.rows());
  return covariance;
}

}  // namespace

Gaussian unscentedPredict(const Gaussian& belief, const NonlinearModel& transition,
                          const UnscentedOptions& options) {
  Spread points = spread(belief, transition, options);
  const Eigen::VectorXd mean = points.center + centred(points);
  return {mean, covarianceOf(points, transition.W)};
}

KalmanUpdate unscentedUpdate(const Gaussian& predicted, const NonlinearModel& observation, const VectorArg& y,
                             const UnscentedOptions& options) {
  Spread points = spread(predicted, observation, options);
  internal::requireObservation(y, points.center.size());
  KalmanUpdate result;
  const Eigen::VectorXd shift = centred(points);
  result.innovation = difference(observation, y, points.center + shift);
  result.innovationCovariance = covarianceOf(points, observation.W);
  const Eigen::MatrixXd cross =
      points.offsets * points.covarianceWeights.asDiagonal() * points.values.transpose();
  const Eigen::MatrixXd K = internal::weighInnovation(cross, result);
  result.belief.mean = predicted.mean + K * result.innovation;
  result.belief.covariance =
      symmetrized(predicted.covariance - K * result.innovationCovariance * K.transpose());
  return result;
}

}  // namespace rex
