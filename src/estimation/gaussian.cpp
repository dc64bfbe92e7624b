#include "estimation/gaussian.h"

#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "base/rng.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"

namespace rex {
namespace {

void requireGaussian(const Gaussian& x, Definiteness wanted = Definiteness::kSemidefinite) {
  requireFinite("mean", x.mean);
  requireCovariance("covariance", x.covariance, x.mean.size(), wanted);
}

}  // namespace

CanonicalGaussian toCanonical(const Gaussian& x) {
  requireGaussian(x, Definiteness::kPositive);
  const auto factor = definiteFactor("covariance", x.covariance);
  const auto identity = Eigen::MatrixXd::Identity(x.mean.size(), x.mean.size());
  return {factor.solve(x.mean), symmetrized(factor.solve(identity))};
}

Gaussian toNormal(const CanonicalGaussian& x) {
  requireFinite("coefficient a", x.a);
  requireCovariance("precision", x.A, x.a.size(), Definiteness::kPositive);
  const auto factor = definiteFactor("precision", x.A);
  const auto identity = Eigen::MatrixXd::Identity(x.a.size(), x.a.size());
  return {factor.solve(x.a), symmetrized(factor.solve(identity))};
}

double logDensity(const Gaussian& gaussian, const VectorArg& x) {
  requireGaussian(gaussian, Definiteness::kPositive);
  requireSize("point", x.size(), gaussian.mean.size());
  return internal::logNormal(definiteFactor("covariance", gaussian.covariance), x - gaussian.mean);
}

double squaredMahalanobis(const Gaussian& gaussian, const VectorArg& x) {
  requireGaussian(gaussian, Definiteness::kPositive);
  requireSize("point", x.size(), gaussian.mean.size());
  const Eigen::VectorXd error = x - gaussian.mean;
  const Eigen::VectorXd weighted = definiteFactor("covariance", gaussian.covariance).solve(error);
  return error.dot(weighted);
}

Eigen::VectorXd sample(const Gaussian& gaussian, Rng& rng) {
  requireGaussian(gaussian);
  return gaussian.mean +
         covarianceRoot(gaussian.covariance) * rng.normalVector(static_cast<int>(gaussian.mean.size()));
}

GaussianProduct multiplied(const Gaussian& a, const Gaussian& b) {
  requireGaussian(a);
  requireGaussian(b);
  requireSize("mean of the second Gaussian", b.mean.size(), a.mean.size());
  const auto factor = definiteFactor("sum of the covariances", a.covariance + b.covariance);
  const Eigen::MatrixXd gain = factor.solve(a.covariance).transpose();  // A (A + B)^-1
  GaussianProduct product;
  product.gaussian.mean = a.mean + gain * (b.mean - a.mean);
  product.gaussian.covariance = symmetrized(gain * b.covariance);
  product.logFactor = internal::logNormal(factor, a.mean - b.mean);
  return product;
}

CanonicalGaussian multiplied(const CanonicalGaussian& a, const CanonicalGaussian& b) {
  requireFinite("coefficient a", a.a);
  requireFinite("coefficient b", b.a);
  requireSize("coefficient b", b.a.size(), a.a.size());
  requireCovariance("precision A", a.A, a.a.size());
  requireCovariance("precision B", b.A, a.a.size());
  return {a.a + b.a, a.A + b.A};
}

Gaussian propagated(const Gaussian& y, const MatrixArg& F, const VectorArg& f, const MatrixArg& Q) {
  requireGaussian(y);
  requireSize("columns of F", F.cols(), y.mean.size());
  requireSize("offset f", f.size(), F.rows());
  requireCovariance("noise Q", Q, F.rows());
  const Eigen::MatrixXd A = F, moved = A * y.covariance * A.transpose();
  return {f + F * y.mean, symmetrized(moved + Q)};
}

GaussianProduct pulledBack(const Gaussian& y, const MatrixArg& F, const VectorArg& f) {
  requireGaussian(y);
  requireSize("rows of F", F.rows(), y.mean.size());
  requireSize("columns of F", F.cols(), y.mean.size());
  requireSize("offset f", f.size(), y.mean.size());
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(F);
  if (!factor.isInvertible())
    throw Error({.what = "transformation F",
                 .found = fmt::format("rank {}", factor.rank()),
                 .wanted = fmt::format("an invertible matrix, of rank {}", F.rows())});
  const Eigen::MatrixXd inverse = factor.inverse();
  const double logFactor = -factor.matrixLU().diagonal().cwiseAbs().array().log().sum();
  return {{inverse * (y.mean - f), symmetrized(inverse * y.covariance * inverse.transpose())}, logFactor};
}

Gaussian marginal(const Gaussian& joint, int first, int count) {
  requireGaussian(joint);
  if (first < 0 || count < 0 || count > joint.mean.size() - first) {
    throw Error({.what = "marginal",
                 .found = fmt::format("{} numbers from {} on", count, first),
                 .wanted = fmt::format("numbers within 0 to {}", joint.mean.size() - 1)});
  }
  return {joint.mean.segment(first, count), joint.covariance.block(first, first, count, count)};
}

Gaussian conditional(const Gaussian& joint, const VectorArg& firstNumbers) {
  requireGaussian(joint);
  requireFinite("given numbers", firstNumbers);
  const Eigen::Index n = firstNumbers.size(), m = joint.mean.size() - n;
  if (m < 0) requireSize("given numbers", n, joint.mean.size());
  const auto factor = definiteFactor("covariance of the given numbers", joint.covariance.topLeftCorner(n, n));
  const Eigen::MatrixXd cross = joint.covariance.topRightCorner(n, m);
  const Eigen::MatrixXd gain = factor.solve(cross).transpose(), lost = gain * cross;
  const Eigen::MatrixXd reduced = joint.covariance.bottomRightCorner(m, m) - lost;
  return {joint.mean.tail(m) + gain * (firstNumbers - joint.mean.head(n)), symmetrized(reduced)};
}

}  // namespace rex
