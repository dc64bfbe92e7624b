#include "learning/power.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

void requireNoise(const LinearGaussianPolicy& policy) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(policy.Sigma, Eigen::EigenvaluesOnly);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  if (!(values[0] > 1e-12 * values[values.size() - 1]))
    throw Error({.what = "Sigma of the policy",
                 .found = "a direction without noise",
                 .wanted = "a positive definite matrix, for PoWER"});
}

}  // namespace

PowerStep powerStep(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                    double discount) {
  requireTrials(policy, episodes, discount);
  requireNoise(policy);
  const Eigen::Index k = policy.beta.size();
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(k, k);
  Eigen::VectorXd moves = Eigen::VectorXd::Zero(k);
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const Episode& episode = episodes[i];
    const Eigen::VectorXd Q = returnsToGo(episode.rewards, discount);
    for (Eigen::Index t = 0; t < Q.size(); ++t) {
      if (Q[t] < 0)
        throw Error({.what = fmt::format("return of episode {} from step {}", i, t),
                     .found = fmt::format("{:g}", Q[t]),
                     .wanted = "0 or more, for PoWER"});
      const auto phi = episode.features.col(t);
      const double variance = actionVariance(policy, phi);
      if (!(variance > 0)) continue;
      weights += phi * phi.transpose() * (Q[t] / variance);
      moves += phi * (phi.dot(episode.noise.col(t)) * Q[t] / variance);
    }
  }
  PowerStep step{PowerStatus::kNoReturn, policy.beta, ""};
  // Features may have any units, so dependence is judged with a diagonal of ones.
  const Eigen::VectorXd diagonal = weights.diagonal();
  const Eigen::VectorXd scale = (diagonal.array() > 0).select(diagonal.array().rsqrt(), 0.);
  const Eigen::LDLT<Eigen::MatrixXd> factors(scale.asDiagonal() * weights * scale.asDiagonal());
  if (!(factors.vectorD().minCoeff() > 1e-12)) {
    step.message = "no step: the returns are all zero, or the features are linearly dependent";
    return step;
  }
  step.beta += scale.asDiagonal() * factors.solve(scale.asDiagonal() * moves);
  step.status = PowerStatus::kMoved;
  step.message = "moved";
  return step;
}

}  // namespace rex
