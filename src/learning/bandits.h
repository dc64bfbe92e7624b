#pragma once

#include <vector>

#include <Eigen/Core>

namespace rex {

class Rng;

/// What is known of the arms of a bandit, each of which pays numbers from 0 to 1: how often each was pulled,
/// and the sum of what it paid.
struct ArmRecord {
  Eigen::VectorXi pulls{};
  Eigen::VectorXd paid{};
};

/// How the next arm is chosen. Slide 6:22.
enum class BanditRule {
  kEpsilonGreedy,  ///< the best mean so far, or with probability epsilon any arm
  kUcb,            ///< the largest mean + sqrt(2 log n / pulls): UCB1 of Auer, Cesa-Bianchi and Fischer, 2002
  kThompson        ///< the largest draw from the posteriors Beta(1 + paid, 1 + pulls - paid)
};

/// The arm to pull next; ties are broken at random. Those that were never pulled come first, except for
/// kThompson. Throws Error for no arms, vectors of different sizes, sums that such payments cannot have, and
/// an epsilon outside [0, 1].
[[nodiscard]] int nextArm(const ArmRecord& record, BanditRule rule, Rng& rng, double epsilon = 0.1);

struct BanditRun {
  ArmRecord record{};
  std::vector<double> regret{};  ///< after each pull: what the best arm would have paid more on average
};

/// Pulls arms that pay 1 with these probabilities and else 0. Throws Error like nextArm(), for probabilities
/// outside [0, 1], and for fewer than one pull.
[[nodiscard]] BanditRun playBandit(const Eigen::VectorXd& probabilities, int pulls, BanditRule rule, Rng& rng,
                                   double epsilon = 0.1);

}  // namespace rex
