#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "base/rng.h"
#include "base/vector_arg.h"

namespace rex {

/// An action a = phi(s)^T (beta + epsilon) with epsilon ~ N(0, Sigma), new in each step, slides 9:16 and
/// 9:17. In other words a ~ N(phi^T beta, phi^T Sigma phi). With Sigma only at a feature that is always one,
/// the noise is that of the action.
struct LinearGaussianPolicy {
  Eigen::VectorXd beta{};   ///< k
  Eigen::MatrixXd Sigma{};  ///< k x k, a covariance
};

/// Throws Error for sizes that do not fit, what is not finite, and a Sigma that is not a covariance.
void requirePolicy(const LinearGaussianPolicy& policy);
/// A root L of Sigma, so that L times standard normals is epsilon. Throws as requirePolicy.
[[nodiscard]] Eigen::MatrixXd noiseRoot(const LinearGaussianPolicy& policy);

/// phi^T Sigma phi, the variance of the action; zero if it is no more than rounding. phi has k numbers.
[[nodiscard]] double actionVariance(const LinearGaussianPolicy& policy, const VectorArg& phi);

/// What one episode of T steps teaches. Shorter than others if it was cut at a failure: nothing follows.
struct Episode {
  Eigen::MatrixXd features{};  ///< k x T: phi(s_t)
  Eigen::MatrixXd noise{};     ///< k x T: epsilon_t
  Eigen::VectorXd rewards{};   ///< T
};

/// Throws Error naming the episode for sizes that do not fit, and what is not finite; Error if there is none.
void requireEpisodes(const std::vector<Episode>& episodes, Eigen::Index features);
/// The same of all that a search for a better policy goes by; the discount lies in [0, 1].
void requireTrials(const LinearGaussianPolicy& policy, const std::vector<Episode>& episodes, double discount);

/// Runs `count` episodes of a policy; the way to all simulators, which may run them side by side.
using Rollouts = std::function<std::vector<Episode>(const LinearGaussianPolicy& policy, int count, Rng& rng)>;

/// sum_{t' >= t} discount^(t' - t) r_t' for each t: Q(s_t, a_t, t) of slide 9:17, as one episode saw it.
[[nodiscard]] Eigen::VectorXd returnsToGo(const VectorArg& rewards, double discount);

/// Mean of the discounted returns of episodes. Throws as requireEpisodes.
[[nodiscard]] double meanReturn(const std::vector<Episode>& episodes, double discount);

/// A task of one action per step, for simulators that run one episode at a time.
struct ControlTask {
  struct Outcome {
    Eigen::VectorXd next{};
    double reward = 0;
    bool failed = false;  ///< the episode ends here, with this reward as the last
  };
  std::function<Eigen::VectorXd(Rng& rng)> start{};
  std::function<Eigen::VectorXd(const Eigen::VectorXd& state)> features{};
  std::function<Outcome(const Eigen::VectorXd& state, double action, Rng& rng)> step{};
  int horizon = 100;
};
/// Rollouts of it. Throws Error for missing functions and a horizon that is not positive; the rollouts throw
/// as requirePolicy, and Error for another number of features.
[[nodiscard]] Rollouts rolloutsOf(ControlTask task);

}  // namespace rex
