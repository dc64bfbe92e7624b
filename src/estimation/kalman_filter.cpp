#include "estimation/kalman_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/gaussian.h"
#include "estimation/kalman_filter_internal.h"

namespace rex::internal {

double logNormal(const Eigen::LLT<Eigen::MatrixXd>& factor, const VectorArg& error) {
  const double n = static_cast<double>(error.size());
  const double logDeterminant = 2 * factor.matrixLLT().diagonal().array().log().sum();
  const double distance = factor.matrixL().solve(error).squaredNorm();
  return -0.5 * (n * std::log(2 * std::numbers::pi) + logDeterminant + distance);
}

Eigen::MatrixXd weighInnovation(const Eigen::MatrixXd& cross, KalmanUpdate& update) {
  const auto factor = definiteFactor("covariance of the innovation", update.innovationCovariance);
  update.squaredInnovation = factor.matrixL().solve(update.innovation).squaredNorm();
  update.logLikelihood = logNormal(factor, update.innovation);
  return factor.solve(cross.transpose()).transpose();
}

void requireBelief(const Gaussian& belief) {
  requireFinite("mean of the belief", belief.mean);
  requireCovariance("covariance of the belief", belief.covariance, belief.mean.size());
}

void requireObservation(const VectorArg& y, Eigen::Index wanted) {
  requireSize("observation", y.size(), wanted);
  requireFinite("observation", y);
}

}  // namespace rex::internal

namespace rex {
namespace {

using internal::requireBelief;
using internal::requireObservation;
using internal::weighInnovation;

// The update by a model that is known to fit; the innovation is given, since angles need care there.
KalmanUpdate update(const Gaussian& predicted, const LinearModel& model, Eigen::VectorXd innovation) {
  const Eigen::MatrixXd& S = predicted.covariance;
  KalmanUpdate result;
  result.innovation = std::move(innovation);
  const Eigen::MatrixXd cross = S * model.C.transpose();
  result.innovationCovariance = symmetrized(model.W + model.C * cross);
  const Eigen::MatrixXd K = weighInnovation(cross, result);
  result.belief.mean = predicted.mean + K * result.innovation;
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(S.rows(), S.rows()) - K * model.C;
  result.belief.covariance = symmetrized(rest * S * rest.transpose() + K * model.W * K.transpose());
  return result;
}

}  // namespace

Gaussian kalmanPredict(const Gaussian& belief, const LinearModel& transition) {
  requireBelief(belief);
  requireModel("transition", transition, belief.mean.size());
  return propagated(belief, transition.C, transition.c, transition.W);
}

KalmanUpdate kalmanUpdate(const Gaussian& predicted, const LinearModel& observation, const VectorArg& y) {
  requireBelief(predicted);
  requireModel("observation model", observation, predicted.mean.size());
  requireObservation(y, observation.c.size());
  return update(predicted, observation, y - observation.C * predicted.mean - observation.c);
}

Gaussian extendedPredict(const Gaussian& belief, const NonlinearModel& transition) {
  requireBelief(belief);
  return kalmanPredict(belief, linearized(transition, belief.mean));
}

KalmanUpdate extendedUpdate(const Gaussian& predicted, const NonlinearModel& observation,
                            const VectorArg& y) {
  requireBelief(predicted);
  const LinearModel tangent = linearized(observation, predicted.mean);
  requireObservation(y, tangent.c.size());
  return update(predicted, tangent, difference(observation, y, tangent.C * predicted.mean + tangent.c));
}

namespace {

void requireCanonical(const CanonicalGaussian& x) {
  requireFinite("coefficient of the belief", x.a);
  requireCovariance("precision of the belief", x.A, x.a.size());
}

}  // namespace

CanonicalGaussian informationPredict(const CanonicalGaussian& belief, const LinearModel& transition) {
  requireCanonical(belief);
  requireModel("transition", transition, belief.a.size());
  const Eigen::Index n = belief.a.size();
  requireSize("transition: rows of the matrix", transition.C.rows(), n);
  requireCovariance("transition: covariance of the noise", transition.W, n, Definiteness::kPositive);
  const Eigen::FullPivLU<Eigen::MatrixXd> forward(transition.C);
  if (!forward.isInvertible())
    throw Error({.what = "transition: matrix",
                 .found = fmt::format("rank {}", forward.rank()),
                 .wanted = "an invertible matrix, for a filter in canonical form"});
  // The belief carried along without noise, N[x | b, B]; a belief that knows nothing keeps B singular.
  const Eigen::MatrixXd back = forward.inverse();
  const Eigen::MatrixXd B = symmetrized(back.transpose() * belief.A * back);
  const Eigen::VectorXd b = back.transpose() * belief.a + B * transition.c;
  // (B^-1 + Q)^-1 = P (B + P)^-1 B with P = Q^-1, which needs no inverse of B and no subtraction.
  const Eigen::LLT<Eigen::MatrixXd> noise(transition.W);
  const Eigen::MatrixXd P = symmetrized(noise.solve(Eigen::MatrixXd::Identity(n, n)));
  const Eigen::LLT<Eigen::MatrixXd> sum(B + P);
  return {P * sum.solve(b), symmetrized(P * sum.solve(B))};
}

CanonicalGaussian informationUpdate(const CanonicalGaussian& predicted, const LinearModel& observation,
                                    const VectorArg& y) {
  requireCanonical(predicted);
  requireModel("observation model", observation, predicted.a.size());
  internal::requireObservation(y, observation.c.size());
  requireCovariance("observation model: covariance of the noise", observation.W, y.size(),
                    Definiteness::kPositive);
  const Eigen::LLT<Eigen::MatrixXd> noise(observation.W);
  return {predicted.a + observation.C.transpose() * noise.solve(y - observation.c),
          predicted.A + symmetrized(observation.C.transpose() * noise.solve(observation.C))};
}

namespace {

// A lower triangular L with L L^T = M M^T.
Eigen::MatrixXd lowerRoot(const Eigen::MatrixXd& M) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(M.transpose());
  const Eigen::Index n = M.rows();
  Eigen::MatrixXd L = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().transpose();
  // A root is as good as its negative; we want the diagonal positive.
  for (Eigen::Index i = 0; i < n; ++i)
    if (L(i, i) < 0) L.col(i) *= -1;
  return L;
}

void requireRoot(const RootGaussian& x) {
  requireFinite("mean of the belief", x.mean);
  requireSize("rows of the root of the belief", x.L.rows(), x.mean.size());
  requireSize("columns of the root of the belief", x.L.cols(), x.mean.size());
  if (!x.L.allFinite()) throw Error({.what = "root of the belief", .found = "entries that are not finite"});
}

}  // namespace

RootGaussian toRoot(const Gaussian& x) {
  internal::requireBelief(x);
  return {x.mean, lowerRoot(covarianceRoot(x.covariance))};
}

Gaussian toNormal(const RootGaussian& x) {
  requireRoot(x);
  return {x.mean, x.L * x.L.transpose()};
}

RootGaussian rootPredict(const RootGaussian& belief, const LinearModel& transition) {
  requireRoot(belief);
  requireModel("transition", transition, belief.mean.size());
  const Eigen::Index n = transition.c.size();
  Eigen::MatrixXd array(n, belief.mean.size() + n);
  array << transition.C * belief.L, covarianceRoot(transition.W);
  return {transition.C * belief.mean + transition.c, lowerRoot(array)};
}

RootGaussian rootUpdate(const RootGaussian& predicted, const LinearModel& observation, const VectorArg& y) {
  requireRoot(predicted);
  requireModel("observation model", observation, predicted.mean.size());
  internal::requireObservation(y, observation.c.size());
  // [ sqrt(W)  C L ]  is turned into  [ sqrt(innovation covariance)   0          ]
  // [    0      L  ]                  [ gain * that                   new root   ].
  const Eigen::Index m = y.size(), n = predicted.mean.size();
  Eigen::MatrixXd array = Eigen::MatrixXd::Zero(m + n, m + n);
  array.topLeftCorner(m, m) = covarianceRoot(observation.W);
  array.topRightCorner(m, n) = observation.C * predicted.L;
  array.bottomRightCorner(n, n) = predicted.L;
  const Eigen::MatrixXd turned = lowerRoot(array);
  const auto innovationRoot = turned.topLeftCorner(m, m);
  // Each diagonal entry is what is left of the length of its row.
  const Eigen::VectorXd rounding = 4e-16 * static_cast<double>(m + n) * innovationRoot.rowwise().norm();
  if (!(innovationRoot.diagonal().array() > rounding.array()).all())
    throw Error({.what = "covariance of the innovation",
                 .found = "a singular matrix",
                 .wanted = "a positive definite matrix"});
  const Eigen::VectorXd innovation = y - observation.C * predicted.mean - observation.c;
  const Eigen::VectorXd whitened = innovationRoot.triangularView<Eigen::Lower>().solve(innovation);
  return {predicted.mean + turned.bottomLeftCorner(n, m) * whitened, turned.bottomRightCorner(n, n)};
}

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

namespace {

// B A^-1 of a semidefinite A, by the pseudoinverse if it is singular: what is certain stays so.
Eigen::MatrixXd dividedBy(const Eigen::MatrixXd& B, const Eigen::MatrixXd& A) {
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  if (factor.info() == Eigen::Success) return factor.solve(B.transpose()).transpose();
  return A.completeOrthogonalDecomposition().solve(B.transpose()).transpose();
}

}  // namespace

std::vector<Gaussian> smoothed(std::span<const Gaussian> filtered, std::span<const LinearModel> transitions) {
  std::vector<Gaussian> result(filtered.begin(), filtered.end());
  requireSize("transitions between the beliefs", static_cast<long>(transitions.size()),
              std::max(0L, static_cast<long>(filtered.size()) - 1));
  if (filtered.empty()) return result;
  internal::requireBelief(filtered.back());
  for (std::size_t t = transitions.size(); t-- > 0;) {
    const Gaussian predicted = kalmanPredict(filtered[t], transitions[t]);
    const Gaussian& later = result[t + 1];
    requireSize("mean of the next belief", later.mean.size(), predicted.mean.size());
    const Eigen::MatrixXd G =
        dividedBy(filtered[t].covariance * transitions[t].C.transpose(), predicted.covariance);
    result[t].mean = filtered[t].mean + G * (later.mean - predicted.mean);
    result[t].covariance =
        symmetrized(filtered[t].covariance + G * (later.covariance - predicted.covariance) * G.transpose());
  }
  return result;
}

}  // namespace rex
