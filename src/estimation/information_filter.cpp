#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "estimation/covariance.h"
#include "estimation/innovation_internal.h"
#include "estimation/kalman_filter.h"

namespace rex {
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

}  // namespace rex
