#include <Eigen/QR>

#include "base/error.h"
#include "base/require.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"
#include "estimation/kalman_filter.h"

namespace rex {
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

}  // namespace rex
