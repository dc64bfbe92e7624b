#include "optim/gaussian_process.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::gaussian_process_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr GaussianKernel kKernels[] = {GaussianKernel::kSquaredExponential, GaussianKernel::kMatern52};

double covariance(const VectorXd& a, const VectorXd& b, const GaussianProcessParameters& p,
                  GaussianKernel kernel) {
  const double r = std::hypot((a[0] - b[0]) / p.lengths[0], (a[1] - b[1]) / p.lengths[1]);
  const double root = std::sqrt(5.) * r;
  return p.deviation * p.deviation *
         (kernel == GaussianKernel::kMatern52 ? (1 + root + 5 * r * r / 3) * std::exp(-root)
                                              : std::exp(-r * r / 2));
}

struct Observations {
  MatrixXd X;
  VectorXd y;
};

Observations observed(int n, Rng& rng) {
  return {rng.uniformVector(2 * n, -1, 1).reshaped(2, n), rng.normalVector(n)};
}

// Conditioning of the joint normal distribution, by its inverse and determinant. Here and below, differences
// of 1e-7 are those of the 1e-5 deviations of noise that are always added.
TEST(GaussianProcess, ConditionsTheJointDistribution) {
  Rng rng(1);
  const Observations seen = observed(12, rng);
  const GaussianProcessParameters p{
      .mean = 0.3, .deviation = 1.7, .lengths = Vector2d(0.4, 0.9), .noise = 0.2};
  for (const GaussianKernel kernel : kKernels) {
    const GaussianProcess process(seen.X, seen.y, p, kernel);
    MatrixXd K(12, 12);
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        K(i, j) = covariance(seen.X.col(i), seen.X.col(j), p, kernel) + (i == j ? 0.04 : 0);
    const MatrixXd inverse = K.inverse();
    const VectorXd offsets = seen.y.array() - 0.3;
    EXPECT_NEAR(process.logLikelihood(),
                -(offsets.dot(inverse * offsets) + std::log(K.determinant()) + 12 * std::log(2 * M_PI)) / 2,
                1e-6);
    for (int trial = 0; trial < 5; ++trial) {
      const VectorXd x = rng.uniformVector(2, -1, 1);
      VectorXd k(12);
      for (int i = 0; i < 12; ++i) k[i] = covariance(x, seen.X.col(i), p, kernel);
      const GaussianPrediction at = process.predict(x);
      EXPECT_NEAR(at.mean, 0.3 + k.dot(inverse * offsets), 1e-8);
      EXPECT_NEAR(at.deviation * at.deviation, 1.7 * 1.7 - k.dot(inverse * k), 1e-8);
    }
  }
}

// Of features exp(-((x - c) / l)^2) with independent normal weights at centres c close to each other, linear
// regression is the same: the product of two such features, over all centres, is proportional to the kernel.
TEST(GaussianProcess, IsRegressionOnManyFeatures) {
  Rng rng(2);
  const double length = 0.5, deviation = 1.3, noise = 0.1, spacing = 0.1;
  const MatrixXd X = rng.uniformVector(8, -1, 1).transpose();
  const VectorXd y = rng.normalVector(8);
  const VectorXd centres = VectorXd::LinSpaced(81, -4, 4);
  // The sum over centres of exp(-2 (c - m)^2 / l^2) is l sqrt(pi / 2) / spacing.
  const double scale = deviation * std::sqrt(spacing / (length * std::sqrt(M_PI / 2)));
  const auto features = [&](double x) -> VectorXd {
    return scale * (-((x - centres.array()) / length).square()).exp();
  };
  MatrixXd Phi(8, 81);
  for (int i = 0; i < 8; ++i) Phi.row(i) = features(X(0, i)).transpose();
  // The posterior of the weights.
  const MatrixXd precision = MatrixXd::Identity(81, 81) + Phi.transpose() * Phi / (noise * noise);
  const VectorXd mean = precision.ldlt().solve(VectorXd(Phi.transpose() * y)) / (noise * noise);
  const GaussianProcess process(
      X, y, {.deviation = deviation, .lengths = VectorXd::Constant(1, length), .noise = noise},
      GaussianKernel::kSquaredExponential);
  for (const double x : {-0.8, 0., 0.33, 1.5}) {
    const GaussianPrediction at = process.predict(VectorXd::Constant(1, x));
    const VectorXd phi = features(x);
    EXPECT_NEAR(at.mean, phi.dot(mean), 1e-7);
    EXPECT_NEAR(at.deviation * at.deviation, phi.dot(precision.ldlt().solve(phi)), 1e-7);
  }
}

// In one dimension a process with Matern's kernel 5/2 is that of three linear stochastic differential
// equations, and a Kalman filter gives the likelihood (Hartikainen and Sarkka, 2010).
TEST(GaussianProcess, HasTheLikelihoodOfAKalmanFilter) {
  Rng rng(3);
  const double length = 0.7, deviation = 1.4, noise = 0.3, rate = std::sqrt(5.) / length;
  VectorXd x = rng.uniformVector(30, 0, 5);
  std::sort(x.begin(), x.end());
  const VectorXd y = rng.normalVector(30);
  const double variance = deviation * deviation, slope = variance * rate * rate / 3;
  const Eigen::Matrix3d stationary{
      {variance, 0, -slope}, {0, slope, 0}, {-slope, 0, variance * std::pow(rate, 4)}};
  const Eigen::Matrix3d F{{0, 1, 0}, {0, 0, 1}, {-std::pow(rate, 3), -3 * rate * rate, -3 * rate}};
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity(), N = F + rate * I;  // N^3 = 0
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d P = stationary;
  double logLikelihood = 0;
  for (int i = 0; i < 30; ++i) {
    if (i > 0) {
      const double step = x[i] - x[i - 1];
      const Eigen::Matrix3d A = std::exp(-rate * step) * (I + step * N + step * step / 2 * N * N);
      mean = A * mean;
      P = A * (P - stationary) * A.transpose() + stationary;
    }
    const double expected = P(0, 0) + noise * noise, miss = y[i] - mean[0];
    logLikelihood -= (std::log(2 * M_PI * expected) + miss * miss / expected) / 2;
    const Eigen::Vector3d gain = P.col(0) / expected;
    mean += gain * miss;
    P -= gain * P.row(0).eval();
  }
  const GaussianProcess process(
      x.transpose(), y, {.deviation = deviation, .lengths = VectorXd::Constant(1, length), .noise = noise});
  EXPECT_NEAR(process.logLikelihood(), logLikelihood, 1e-6);
}

GaussianProcessParameters parametersOf(const VectorXd& logs) {
  return {.mean = logs[0],
          .deviation = std::exp(logs[1]),
          .lengths = logs.segment(2, 2).array().exp(),
          .noise = std::exp(logs[4])};
}

TEST(GaussianProcess, KnowsItsGradients) {
  Rng rng(4);
  const Observations seen = observed(10, rng);
  const VectorXd logs = (VectorXd(5) << 0.2, 0.3, -0.8, -0.1, -1).finished();
  for (const GaussianKernel kernel : kKernels) {
    const GaussianProcess process(seen.X, seen.y, parametersOf(logs), kernel);
    const auto likelihood = [&](const VectorXd& at) {
      return VectorXd::Constant(1, GaussianProcess(seen.X, seen.y, parametersOf(at), kernel).logLikelihood());
    };
    EXPECT_LT((numericJacobian(likelihood, logs).transpose() - process.logLikelihoodGradient()).norm(), 1e-6);
    const Vector2d x(0.1, -0.4);
    const auto prediction = [&](const VectorXd& at) {
      const GaussianPrediction found = process.predict(at);
      return VectorXd(Vector2d(found.mean, found.deviation));
    };
    const GaussianPrediction at = process.predict(x);
    MatrixXd gradients(2, 2);
    gradients << at.meanGradient.transpose(), at.deviationGradient.transpose();
    EXPECT_LT((numericJacobian(prediction, x) - gradients).norm(), 1e-7);
  }
}

TEST(GaussianProcess, GoesThroughExactValues) {
  Rng rng(5);
  const Observations seen = observed(8, rng);
  const GaussianProcess process(seen.X, seen.y, {.lengths = Vector2d(0.3, 0.3)});
  for (int i = 0; i < 8; ++i) {
    const GaussianPrediction at = process.predict(seen.X.col(i));
    EXPECT_NEAR(at.mean, seen.y[i], 1e-7);
    EXPECT_LT(at.deviation, 2e-5);
  }
  const GaussianPrediction far = process.predict(Vector2d(50, 50));
  EXPECT_NEAR(far.mean, 0, 1e-9);
  EXPECT_NEAR(far.deviation, 1, 1e-9);
}

// A sample of a known process: chol(K) times normal numbers.
TEST(GaussianProcess, FindsTheParametersOfASample) {
  for (const GaussianKernel kernel : kKernels)
    for (const std::uint64_t seed : {1, 2, 3}) {
      Rng rng(seed);
      const GaussianProcessParameters truth{
          .mean = 5, .deviation = 2, .lengths = Vector2d(0.2, 0.6), .noise = 0.2};
      constexpr int kCount = 150;
      Observations seen = observed(kCount, rng);
      MatrixXd K(kCount, kCount);
      for (int i = 0; i < kCount; ++i)
        for (int j = 0; j < kCount; ++j)
          K(i, j) = covariance(seen.X.col(i), seen.X.col(j), truth, kernel) + (i == j ? 0.04 : 0);
      const MatrixXd root = K.llt().matrixL();
      seen.y = (root * rng.normalVector(kCount)).array() + 5;
      const GaussianProcess fitted =
          fittedGaussianProcess(seen.X, seen.y, {.kernel = kernel, .isNoisy = true});
      const GaussianProcessParameters& p = fitted.parameters();
      EXPECT_NEAR(std::log(p.deviation / 2), 0, 0.5) << seed;
      EXPECT_NEAR(std::log(p.lengths[0] / 0.2), 0, 0.3) << seed;
      EXPECT_NEAR(std::log(p.lengths[1] / 0.6), 0, 0.4) << seed;
      EXPECT_NEAR(std::log(p.noise / 0.2), 0, 0.4) << seed;
      // A maximum of the likelihood in all parameters, also those that the fit eliminates.
      EXPECT_GT(fitted.logLikelihood(), GaussianProcess(seen.X, seen.y, truth, kernel).logLikelihood());
      EXPECT_LT(fitted.logLikelihoodGradient().cwiseAbs().maxCoeff(), 1e-3);
    }
}

TEST(GaussianProcess, StandsEqualAndScaledValues) {
  Rng rng(6);
  Observations seen = observed(9, rng);
  const GaussianProcess flat = fittedGaussianProcess(seen.X, VectorXd::Constant(9, 7));
  EXPECT_NEAR(flat.predict(Vector2d(0.5, 0.5)).mean, 7, 1e-9);
  EXPECT_LT(flat.predict(Vector2d(0.5, 0.5)).deviation, 1e-10);
  EXPECT_EQ(fittedGaussianProcess(seen.X, VectorXd::Zero(9)).predict(Vector2d(0.5, 0.5)).mean, 0);
  const GaussianProcess one = fittedGaussianProcess(seen.X, seen.y);
  const GaussianProcess large = fittedGaussianProcess(seen.X, 1e9 * seen.y);
  EXPECT_NEAR(large.predict(Vector2d(0.5, 0.5)).mean / 1e9, one.predict(Vector2d(0.5, 0.5)).mean, 1e-6);
  // Of a single point, and of points in a line along one coordinate.
  EXPECT_EQ(fittedGaussianProcess(MatrixXd::Ones(2, 1), VectorXd::Constant(1, 3)).parameters().mean, 3);
  seen.X.row(1).setConstant(2);
  EXPECT_TRUE(std::isfinite(fittedGaussianProcess(seen.X, seen.y).logLikelihood()));
}

TEST(GaussianProcess, RefusesWhatMakesNoSense) {
  const MatrixXd X = MatrixXd::Identity(2, 2);
  const Vector2d y(1, 2);
  const GaussianProcessParameters p{.lengths = Vector2d(1, 1)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [&](auto change) {
    GaussianProcessParameters changed = p;
    change(changed);
    return changed;
  };
  EXPECT_REX_ERROR(GaussianProcess(MatrixXd(2, 0), VectorXd(0), p), "Gaussian process: points: found 0");
  EXPECT_REX_ERROR(GaussianProcess(MatrixXd(0, 1), VectorXd::Ones(1), p),
                   "Gaussian process: coordinates of the points: found 0");
  EXPECT_REX_ERROR(GaussianProcess(X, VectorXd::Ones(1), p), "Gaussian process: values");
  EXPECT_REX_ERROR(GaussianProcess(nan * X, y, p), "Gaussian process: point 0: number 0: found nan");
  EXPECT_REX_ERROR(GaussianProcess(X, nan * y, p), "Gaussian process: values: number 0: found nan");
  EXPECT_REX_ERROR(GaussianProcess(X, y, {.lengths = VectorXd::Ones(1)}), "Gaussian process: lengths");
  EXPECT_REX_ERROR(GaussianProcess(X, y, {.lengths = Vector2d(1, 0)}), "Gaussian process: length: found 0");
  EXPECT_REX_ERROR(GaussianProcess(X, y, with([](auto& q) { q.mean = INFINITY; })),
                   "Gaussian process: mean: found inf");
  EXPECT_REX_ERROR(GaussianProcess(X, y, with([](auto& q) { q.deviation = 0; })),
                   "Gaussian process: deviation: found 0");
  EXPECT_REX_ERROR(GaussianProcess(X, y, with([](auto& q) { q.noise = -1; })),
                   "Gaussian process: noise: found -1");
  EXPECT_REX_ERROR(GaussianProcess(X, y, with([](auto& q) { q.deviation = 1e200; })),
                   "covariances of the observations that cannot be factored");
  EXPECT_REX_ERROR(GaussianProcess(X, y, p).predict(VectorXd::Ones(3)), "Gaussian process: point: found");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, VectorXd::Ones(3)), "Gaussian process: values");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.leastLength = 0}), "least length: found 0");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.mostLength = -1}), "most length: found -1");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.leastLength = 2, .mostLength = 1}),
                   "least length: found 2, wanted at most the greatest, 1");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.start = {.lengths = VectorXd::Ones(1)}}),
                   "lengths to begin with");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.start = {.lengths = Vector2d(1, -1)}}),
                   "length to begin with: found -1");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.start = {.deviation = 0, .lengths = Vector2d(1, 1)}}),
                   "deviation to begin with: found 0");
  EXPECT_REX_ERROR(fittedGaussianProcess(X, y, {.start = {.lengths = Vector2d(1, 1), .noise = -1}}),
                   "noise to begin with: found -1");
}

}  // namespace rex::gaussian_process_test
