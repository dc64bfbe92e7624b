#include "optim/gaussian_process.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "optim/box_descent_internal.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Added to the diagonal in units of the variance of f: rounding must not make K indefinite.
constexpr double kJitter = 1e-10;
constexpr double kLogTwoPi = 1.8378770664093453;

struct KernelValue {
  double k = 0;      // the correlation at a squared distance r2
  double slope = 0;  // dk / dr2
};

KernelValue kernelAt(GaussianKernel kernel, double r2) {
  if (kernel == GaussianKernel::kSquaredExponential) {
    const double k = std::exp(-r2 / 2);
    return {k, -k / 2};
  }
  const double r = std::sqrt(5 * r2), decay = std::exp(-r);
  return {(1 + r + r * r / 3) * decay, -5. / 6 * (1 + r) * decay};
}

// Correlations of f at all pairs of points, and their slopes.
struct Correlations {
  MatrixXd C, slopes;
};

Correlations correlationsOf(const MatrixXd& X, const VectorXd& lengths, GaussianKernel kernel) {
  const Index n = X.cols();
  const MatrixXd scaled = X.array().colwise() / lengths.array();
  Correlations all{MatrixXd(n, n), MatrixXd(n, n)};
  for (Index j = 0; j < n; ++j)
    for (Index i = j; i < n; ++i) {
      const KernelValue value = kernelAt(kernel, (scaled.col(i) - scaled.col(j)).squaredNorm());
      all.C(i, j) = all.C(j, i) = value.k;
      all.slopes(i, j) = all.slopes(j, i) = value.slope;
    }
  return all;
}

// sum_ij W_ij dC_ij / dlog length_k of a symmetric W, for each k.
VectorXd alongLengths(const MatrixXd& W, const MatrixXd& slopes, const MatrixXd& X, const VectorXd& lengths) {
  VectorXd sums = VectorXd::Zero(X.rows());
  for (Index j = 0; j < X.cols(); ++j)
    for (Index i = j + 1; i < X.cols(); ++i) {
      const double weight = -4 * W(i, j) * slopes(i, j);
      for (Index k = 0; k < X.rows(); ++k) {
        const double difference = (X(k, i) - X(k, j)) / lengths[k];
        sums[k] += weight * difference * difference;
      }
    }
  return sums;
}

double logDeterminant(const Eigen::LLT<MatrixXd>& factors) {
  double sum = 0;
  for (Index i = 0; i < factors.matrixLLT().rows(); ++i) sum += std::log(factors.matrixLLT()(i, i));
  return 2 * sum;
}

MatrixXd inverseOf(const Eigen::LLT<MatrixXd>& factors) {
  const Index n = factors.matrixLLT().rows();
  return factors.solve(MatrixXd(MatrixXd::Identity(n, n)));
}

void requireObservations(const MatrixXd& X, const VectorXd& y) {
  requireCount("Gaussian process: points", X.cols(), 1);
  requireCount("Gaussian process: coordinates of the points", X.rows(), 1);
  requireSize("Gaussian process: values", y.size(), X.cols());
  for (Index j = 0; j < X.cols(); ++j)
    requireFinite(fmt::format("Gaussian process: point {}", j), VectorXd(X.col(j)));
  requireFinite("Gaussian process: values", y);
}

// What is left of a fit once lengths and noise, relative to the deviation of f, are chosen.
struct Profile {
  double mean = 0, variance = 0, loss = 0;  // loss: -log likelihood
  VectorXd gradient{};                      // of the loss along log lengths and log noise
};

Profile profileOf(const MatrixXd& X, const VectorXd& y, const VectorXd& lengths, double noise,
                  GaussianKernel kernel, double leastVariance) {
  const Index n = X.cols();
  Correlations all = correlationsOf(X, lengths, kernel);
  all.C.diagonal().array() += kJitter + noise * noise;
  const Eigen::LLT<MatrixXd> factors(all.C);
  const VectorXd ones = VectorXd::Ones(n), weights = factors.solve(ones);
  Profile profile{.mean = weights.dot(y) / weights.sum()};
  const VectorXd offsets = y.array() - profile.mean;
  const VectorXd alpha = factors.solve(offsets);
  const auto count = static_cast<double>(n);
  const double squares = offsets.dot(alpha);
  profile.variance = std::max(squares / count, leastVariance);
  profile.loss = (count * (kLogTwoPi + std::log(profile.variance)) + squares / profile.variance +
                  logDeterminant(factors)) /
                 2;
  if (factors.info() != Eigen::Success || !std::isfinite(profile.loss))
    profile.loss = std::numeric_limits<double>::infinity();
  MatrixXd W = inverseOf(factors);
  for (Index j = 0; j < n; ++j) W.col(j) -= alpha * (alpha[j] / profile.variance);
  profile.gradient.resize(lengths.size() + 1);
  profile.gradient.head(lengths.size()) = 0.5 * alongLengths(W, all.slopes, X, lengths);
  profile.gradient[lengths.size()] = noise * noise * W.trace();
  return profile;
}

}  // namespace

GaussianProcess::GaussianProcess(MatrixXd X, VectorXd y, GaussianProcessParameters parameters,
                                 GaussianKernel kernel)
    : X_(std::move(X)), y_(std::move(y)), parameters_(std::move(parameters)), kernel_(kernel) {
  requireObservations(X_, y_);
  requireFinite("Gaussian process: mean", parameters_.mean);
  requirePositive("Gaussian process: deviation", parameters_.deviation);
  requireNotNegative("Gaussian process: noise", parameters_.noise);
  requireSize("Gaussian process: lengths", parameters_.lengths.size(), X_.rows());
  for (const double length : parameters_.lengths) requirePositive("Gaussian process: length", length);
  const double variance = parameters_.deviation * parameters_.deviation;
  MatrixXd K = variance * correlationsOf(X_, parameters_.lengths, kernel_).C;
  K.diagonal().array() += variance * kJitter + parameters_.noise * parameters_.noise;
  factors_.compute(K);
  const VectorXd offsets = y_.array() - parameters_.mean;
  alpha_ = factors_.solve(offsets);
  if (factors_.info() != Eigen::Success || !alpha_.allFinite())
    throw Error({.what = "Gaussian process",
                 .found = "covariances of the observations that cannot be factored",
                 .wanted = "noise, or points further apart"});
}

GaussianPrediction GaussianProcess::predict(const VectorArg& x) const {
  requireSize("Gaussian process: point", x.size(), X_.rows());
  const double variance = parameters_.deviation * parameters_.deviation;
  VectorXd k(X_.cols()), slopes(X_.cols());
  for (Index i = 0; i < X_.cols(); ++i) {
    const KernelValue value =
        kernelAt(kernel_, (x - X_.col(i)).cwiseQuotient(parameters_.lengths).squaredNorm());
    k[i] = variance * value.k;
    slopes[i] = variance * value.slope;
  }
  const VectorXd beta = factors_.solve(k);
  GaussianPrediction at{.mean = parameters_.mean + k.dot(alpha_),
                        .meanGradient = VectorXd::Zero(x.size()),
                        .deviationGradient = VectorXd::Zero(x.size())};
  // At an observation the difference is only rounding; what makes K computable is left.
  at.deviation = std::sqrt(std::max(variance - k.dot(beta), 1e-3 * kJitter * variance));
  for (Index i = 0; i < X_.cols(); ++i)
    for (Index c = 0; c < x.size(); ++c) {
      const double length = parameters_.lengths[c];
      const double change = 2 * slopes[i] * (x[c] - X_(c, i)) / (length * length);
      at.meanGradient[c] += alpha_[i] * change;
      at.deviationGradient[c] -= beta[i] * change / at.deviation;
    }
  return at;
}

double GaussianProcess::logLikelihood() const {
  const double squares = (y_.array() - parameters_.mean).matrix().dot(alpha_);
  return -(squares + logDeterminant(factors_) + static_cast<double>(y_.size()) * kLogTwoPi) / 2;
}

VectorXd GaussianProcess::logLikelihoodGradient() const {
  const Index d = X_.rows(), n = X_.cols();
  const double variance = parameters_.deviation * parameters_.deviation;
  const double noise = parameters_.noise * parameters_.noise;
  const Correlations all = correlationsOf(X_, parameters_.lengths, kernel_);
  MatrixXd W = -inverseOf(factors_);
  for (Index j = 0; j < n; ++j) W.col(j) += alpha_ * alpha_[j];
  VectorXd gradient(d + 3);
  gradient[0] = alpha_.sum();
  gradient[1] = variance * (W.cwiseProduct(all.C).sum() + kJitter * W.trace());
  gradient.segment(2, d) = 0.5 * variance * alongLengths(W, all.slopes, X_, parameters_.lengths);
  gradient[d + 2] = noise * W.trace();
  return gradient;
}

GaussianProcess fittedGaussianProcess(const MatrixArg& X, const VectorArg& y,
                                      const GaussianFitOptions& options) {
  requireObservations(X, y);
  requirePositive("Gaussian process: least length", options.leastLength);
  requirePositive("Gaussian process: most length", options.mostLength);
  const Index d = X.rows();
  VectorXd widths = X.rowwise().maxCoeff() - X.rowwise().minCoeff();
  // Along a coordinate that never changes, any length will do.
  for (double& width : widths)
    if (!(width > 0)) width = 1;
  constexpr double kLeastNoise = 1e-4, kMostNoise = 1;
  VectorXd low(d + 1), high(d + 1), start(d + 1);
  low << (options.leastLength * widths).array().log().matrix(), std::log(kLeastNoise);
  high << (options.mostLength * widths).array().log().matrix(), std::log(kMostNoise);
  if (!(low[0] <= high[0]))
    throw Error({.what = "Gaussian process: least length",
                 .found = fmt::format("{:g}", options.leastLength),
                 .wanted = fmt::format("at most the greatest, {:g}", options.mostLength)});
  start << (widths / 3).array().log().matrix(), std::log(0.1);
  if (options.start.lengths.size() > 0) {
    requireSize("Gaussian process: lengths to begin with", options.start.lengths.size(), d);
    for (const double length : options.start.lengths)
      requirePositive("Gaussian process: length to begin with", length);
    requirePositive("Gaussian process: deviation to begin with", options.start.deviation);
    requireNotNegative("Gaussian process: noise to begin with", options.start.noise);
    start << options.start.lengths.array().log().matrix(),
        std::log(std::max(kLeastNoise, options.start.noise / options.start.deviation));
  }
  if (!options.isNoisy) low[d] = high[d] = start[d] = -400;  // its square is 0

  // Equal values have no deviation.
  const double leastDeviation = std::max(1e-12 * y.cwiseAbs().maxCoeff(), 1e-100);
  const MatrixXd points = X;
  const VectorXd values = y;
  const auto profileAt = [&](const VectorXd& logs) {
    return profileOf(points, values, logs.head(d).array().exp(), std::exp(logs[d]), options.kernel,
                     leastDeviation * leastDeviation);
  };
  const auto loss = [&](const VectorXd& logs, VectorXd& gradient) {
    Profile profile = profileAt(logs);
    gradient.swap(profile.gradient);
    return profile.loss;
  };
  const VectorXd best =
      internal::minimizeInBox(loss, start, low, high, 1e-4, 100 + 20 * static_cast<int>(d)).x;
  const Profile profile = profileAt(best);
  const double deviation = std::sqrt(profile.variance);
  return {points,
          values,
          {.mean = profile.mean,
           .deviation = deviation,
           .lengths = best.head(d).array().exp(),
           .noise = options.isNoisy ? deviation * std::exp(best[d]) : 0},
          options.kernel};
}

}  // namespace rex
