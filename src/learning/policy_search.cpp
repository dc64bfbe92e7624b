#include "learning/policy_search.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

Eigen::MatrixXd scores(const LinearGaussianPolicy& policy, const Episode& episode) {
  Eigen::MatrixXd scores(episode.features.rows(), episode.features.cols());
  for (Eigen::Index t = 0; t < scores.cols(); ++t) {
    const auto phi = episode.features.col(t);
    const double variance = actionVariance(policy, phi);
    scores.col(t) = phi * (variance > 0 ? phi.dot(episode.noise.col(t)) / variance : 0.);
  }
  return scores;
}

// Sums over episodes for each parameter and step: of score^2 Q and of score^2.
struct BaselineSums {
  Eigen::ArrayXXd weighted{}, weights{};
};

BaselineSums baselineSums(const std::vector<Eigen::MatrixXd>& all, const std::vector<Eigen::VectorXd>& Q) {
  Eigen::Index longest = 0;
  for (const auto& one : all) longest = std::max(longest, one.cols());
  BaselineSums sums{Eigen::ArrayXXd::Zero(all.front().rows(), longest),
                    Eigen::ArrayXXd::Zero(all.front().rows(), longest)};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::ArrayXXd squares = all[i].array().square();
    sums.weights.leftCols(all[i].cols()) += squares;
    sums.weighted.leftCols(all[i].cols()) += squares.rowwise() * Q[i].transpose().array();
  }
  return sums;
}

// The baseline that the other episodes give, k x T; zero if there is no other.
Eigen::MatrixXd baselineWithout(const BaselineSums& sums, const Eigen::MatrixXd& scores,
                                const Eigen::VectorXd& Q) {
  const Eigen::ArrayXXd squares = scores.array().square();
  const Eigen::ArrayXXd weights = sums.weights.leftCols(scores.cols()) - squares;
  const Eigen::ArrayXXd weighted =
      sums.weighted.leftCols(scores.cols()) - squares.rowwise() * Q.transpose().array();
  // What remains of a sum after its only term is subtracted is rounding.
  return (weights > 1e-9 * sums.weights.leftCols(scores.cols())).select(weighted / weights, 0.).matrix();
}

Eigen::VectorXd powers(double discount, Eigen::Index count) {
  Eigen::VectorXd weights(count);
  double weight = 1;
  for (double& entry : weights) {
    entry = weight;
    weight *= discount;
  }
  return weights;
}

Eigen::MatrixXd fisherMatrix(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                             double discount) {
  Eigen::MatrixXd F = Eigen::MatrixXd::Zero(policy.beta.size(), policy.beta.size());
  for (const Episode& episode : episodes) {
    const Eigen::MatrixXd g = scores(policy, episode);
    F += g * powers(discount, g.cols()).asDiagonal() * g.transpose();
  }
  return F / static_cast<double>(episodes.size());
}

}  // namespace

Eigen::MatrixXd logGradients(const LinearGaussianPolicy& policy, const Episode& episode) {
  requirePolicy(policy);
  requireEpisodes({episode}, policy.beta.size());
  return scores(policy, episode);
}

PolicyGradient reinforceGradient(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                                 double discount, Baseline baseline) {
  requireTrials(policy, episodes, discount);
  std::vector<Eigen::MatrixXd> all;
  std::vector<Eigen::VectorXd> Q;
  for (const Episode& episode : episodes) {
    all.push_back(scores(policy, episode));
    Q.push_back(returnsToGo(episode.rewards, discount));
  }
  const BaselineSums sums = baselineSums(all, Q);
  const auto count = static_cast<double>(episodes.size());
  Eigen::MatrixXd each(policy.beta.size(), static_cast<Eigen::Index>(episodes.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    Eigen::MatrixXd advantage = Q[i].transpose().replicate(policy.beta.size(), 1);
    if (baseline == Baseline::kOptimal) advantage -= baselineWithout(sums, all[i], Q[i]);
    each.col(static_cast<Eigen::Index>(i)) = all[i].cwiseProduct(advantage) * powers(discount, all[i].cols());
  }
  PolicyGradient result;
  result.gradient = each.rowwise().mean();
  result.standardError.setZero(policy.beta.size());
  if (count > 1)
    result.standardError =
        ((each.colwise() - result.gradient).rowwise().squaredNorm() / (count - 1) / count).cwiseSqrt();
  return result;
}

NaturalGradient naturalGradient(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                                double discount) {
  NaturalGradient result;
  result.gradient = reinforceGradient(policy, episodes, discount).gradient;
  result.fisher = fisherMatrix(policy, episodes, discount);
  // Features may have any units, so the rank is judged with a diagonal of ones.
  const Eigen::VectorXd diagonal = result.fisher.diagonal();
  const Eigen::VectorXd scale = (diagonal.array() > 0).select(diagonal.array().rsqrt(), 0.);
  const Eigen::MatrixXd scaled = scale.asDiagonal() * result.fisher * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scaled);
  const Eigen::VectorXd& values = eigen.eigenvalues();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (!(values[i] > 1e-12)) continue;
    inverse[i] = 1 / values[i];
    ++result.rank;
  }
  const Eigen::MatrixXd axes = scale.asDiagonal() * eigen.eigenvectors();
  result.w = axes * inverse.asDiagonal() * axes.transpose() * result.gradient;
  return result;
}

NaturalGradient episodicNaturalGradient(const LinearGaussianPolicy& policy,
                                        const std::vector<Episode>& episodes, double discount) {
  requireTrials(policy, episodes, discount);
  const Eigen::Index k = policy.beta.size(), count = static_cast<Eigen::Index>(episodes.size());
  Eigen::MatrixXd X(count, k);
  Eigen::VectorXd returns(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Episode& episode = episodes[static_cast<std::size_t>(i)];
    const Eigen::MatrixXd g = scores(policy, episode);
    X.row(i) = (g * powers(discount, g.cols())).transpose();
    returns[i] = returnsToGo(episode.rewards, discount)[0];
  }
  // Features may have any units, so the rank is judged with columns of length one.
  const Eigen::ArrayXd lengths = X.colwise().norm().transpose();
  const Eigen::VectorXd scale = (lengths > 0).select(lengths.inverse(), 0.);
  // With the means removed, no constant has to be fitted.
  X.rowwise() -= X.colwise().mean().eval();
  returns.array() -= returns.mean();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors;
  factors.setThreshold(1e-10);
  factors.compute(X * scale.asDiagonal());
  NaturalGradient result;
  result.w = scale.asDiagonal() * factors.solve(returns);
  result.rank = static_cast<int>(factors.rank());
  result.fisher = fisherMatrix(policy, episodes, discount);
  result.gradient = result.fisher * result.w;
  return result;
}

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

namespace {

void requireOptions(const PolicySearchOptions& options) {
  requireCount("iterations of the search", options.iterations, 1);
  requireCount("episodes of an iteration", options.episodes, 2);
  requirePositive("rate", options.rate);
  requirePositiveOrInfinite("longestStep", options.longestStep);
  if (!(options.noiseDecay > 0 && options.noiseDecay <= 1))
    throw Error({.what = "noiseDecay",
                 .found = fmt::format("{:g}", options.noiseDecay),
                 .wanted = "a number above 0, up to 1"});
}

Eigen::VectorXd stepOf(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                       const PolicySearchOptions& options) {
  switch (options.method) {
    case SearchMethod::kReinforce:
      return options.rate * reinforceGradient(policy, episodes, options.discount).gradient;
    case SearchMethod::kNaturalGradient:
      return options.rate * naturalGradient(policy, episodes, options.discount).w;
    case SearchMethod::kEpisodicNaturalGradient:
      return options.rate * episodicNaturalGradient(policy, episodes, options.discount).w;
    case SearchMethod::kPower:
      break;
  }
  return powerStep(policy, episodes, options.discount).beta - policy.beta;
}

bool areFinite(const std::vector<Episode>& episodes) {
  return std::all_of(episodes.begin(), episodes.end(), [](const Episode& episode) {
    return episode.rewards.allFinite() && episode.features.allFinite();
  });
}

}  // namespace

PolicySearchResult improvedPolicy(const RolloutSource& rollouts, const LinearGaussianPolicy& start,
                                  const PolicySearchOptions& options, Rng& rng) {
  requirePolicy(start);
  requireOptions(options);
  PolicySearchResult result;
  result.policy = result.best = start;
  double most = -std::numeric_limits<double>::infinity();
  const auto stopped = [&](PolicySearchStatus status, const char* why) {
    result.status = status;
    result.message = fmt::format("{} after {} iterations", why, result.iterations);
    return result;
  };
  while (result.iterations < options.iterations) {
    const std::vector<Episode> episodes = rollouts(result.policy, options.episodes, rng);
    if (!areFinite(episodes)) return stopped(PolicySearchStatus::kDiverged, "returns are no longer finite");
    result.returns.push_back(meanReturn(episodes, options.discount));
    if (result.returns.back() > most) {
      most = result.returns.back();
      result.best = result.policy;
    }
    Eigen::VectorXd step = stepOf(result.policy, episodes, options);
    if (!step.allFinite()) return stopped(PolicySearchStatus::kDiverged, "the step is not finite");
    if (step.isZero(0)) return stopped(PolicySearchStatus::kStuck, "no direction promises a higher return");
    if (step.norm() > options.longestStep) step *= options.longestStep / step.norm();
    result.policy.beta += step;
    result.policy.Sigma *= options.noiseDecay;
    ++result.iterations;
  }
  return stopped(PolicySearchStatus::kFinished, "finished");
}

}  // namespace rex
