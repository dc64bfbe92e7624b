#include "learning/linear_gaussian_policy.h"

#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

Episode runEpisode(const ControlTask& task, const LinearGaussianPolicy& policy, const Eigen::MatrixXd& root,
                   Rng& rng) {
  const Eigen::Index k = policy.beta.size();
  Episode episode{Eigen::MatrixXd(k, task.horizon), Eigen::MatrixXd(k, task.horizon),
                  Eigen::VectorXd(task.horizon)};
  Eigen::VectorXd state = task.start(rng);
  int t = 0;
  for (bool goesOn = true; goesOn && t < task.horizon; ++t) {
    const Eigen::VectorXd features = task.features(state);
    requireSize("features of the state", features.size(), k);
    episode.features.col(t) = features;
    episode.noise.col(t) = root * rng.normalVector(static_cast<int>(k));
    ControlTask::Outcome outcome = task.step(state, features.dot(policy.beta + episode.noise.col(t)), rng);
    episode.rewards[t] = outcome.reward;
    goesOn = !outcome.failed;
    state = std::move(outcome.next);
  }
  episode.features.conservativeResize(k, t);
  episode.noise.conservativeResize(k, t);
  episode.rewards.conservativeResize(t);
  return episode;
}

}  // namespace

Eigen::MatrixXd noiseRoot(const LinearGaussianPolicy& policy) {
  const Eigen::Index k = policy.beta.size();
  if (k == 0) throw Error({.what = "policy", .found = "no parameter"});
  requireFinite("beta of the policy", policy.beta);
  requireSize("rows of Sigma", policy.Sigma.rows(), k);
  requireSize("columns of Sigma", policy.Sigma.cols(), k);
  requireFinite("Sigma of the policy", Eigen::VectorXd(policy.Sigma.reshaped()));
  const double scale = policy.Sigma.cwiseAbs().maxCoeff();
  if ((policy.Sigma - policy.Sigma.transpose()).cwiseAbs().maxCoeff() > 1e-12 * scale)
    throw Error({.what = "Sigma of the policy", .found = "a matrix that is not symmetric"});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(policy.Sigma);
  if (eigen.eigenvalues()[0] < -1e-12 * scale)
    throw Error({.what = "Sigma of the policy",
                 .found = fmt::format("the eigenvalue {:g}", eigen.eigenvalues()[0]),
                 .wanted = "none below zero"});
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

void requirePolicy(const LinearGaussianPolicy& policy) { static_cast<void>(noiseRoot(policy)); }

double actionVariance(const LinearGaussianPolicy& policy, const VectorArg& phi) {
  double sum = 0, size = 0;  // both are needed: features may have very different units
  for (Eigen::Index i = 0; i < phi.size(); ++i)
    for (Eigen::Index k = 0; k < phi.size(); ++k) {
      const double term = phi[i] * policy.Sigma(i, k) * phi[k];
      sum += term;
      size += std::abs(term);
    }
  return sum > 1e-14 * size ? sum : 0;
}

void requireEpisodes(const std::vector<Episode>& episodes, Eigen::Index features) {
  if (episodes.empty()) throw Error({.what = "episodes", .found = "none"});
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const Episode& e = episodes[i];
    const auto named = [&](const char* what) { return fmt::format("{} of episode {}", what, i); };
    if (e.rewards.size() == 0) throw Error({.what = named("rewards"), .found = "none"});
    requireSize(named("rows of the features"), e.features.rows(), features);
    requireSize(named("columns of the features"), e.features.cols(), e.rewards.size());
    requireSize(named("rows of the noise"), e.noise.rows(), features);
    requireSize(named("columns of the noise"), e.noise.cols(), e.rewards.size());
    requireFinite(named("rewards"), e.rewards);
    if (!e.features.allFinite())
      throw Error({.what = named("features"), .found = "entries that are not finite"});
    if (!e.noise.allFinite()) throw Error({.what = named("noise"), .found = "entries that are not finite"});
  }
}

void requireTrials(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes,
                   double discount) {
  requirePolicy(policy);
  requireEpisodes(episodes, policy.beta.size());
  if (!(discount >= 0 && discount <= 1))
    throw Error({.what = "discount", .found = fmt::format("{:g}", discount), .wanted = "a number in [0, 1]"});
}

Eigen::VectorXd returnsToGo(const VectorArg& rewards, double discount) {
  Eigen::VectorXd returns = rewards;
  for (Eigen::Index t = rewards.size() - 1; t-- > 0;) returns[t] += discount * returns[t + 1];
  return returns;
}

double meanReturn(const std::vector<Episode>& episodes, double discount) {
  requireEpisodes(episodes, episodes.empty() ? 0 : episodes.front().features.rows());
  double sum = 0;
  for (const Episode& episode : episodes) sum += returnsToGo(episode.rewards, discount)[0];
  return sum / static_cast<double>(episodes.size());
}

RolloutSource rolloutSource(ControlTask task) {
  if (!task.start || !task.features || !task.step)
    throw Error({.what = "task", .found = "a function that is empty", .wanted = "start, features and step"});
  requireCount("horizon of the task", task.horizon, 1);
  return [task = std::move(task)](const LinearGaussianPolicy& policy, int count, Rng& rng) {
    const Eigen::MatrixXd root = noiseRoot(policy);
    std::vector<Episode> episodes;
    for (int i = 0; i < count; ++i) episodes.push_back(runEpisode(task, policy, root, rng));
    return episodes;
  };
}

}  // namespace rex
