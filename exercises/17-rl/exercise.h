#pragma once

#include <functional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. n is the number of states, m that of actions; both are counted from
// 0. Q (n x m) estimates what each action is worth in each state. Slides are named as chapter:number.

/// One step of experience: `action` in `state` paid `reward` and led to `next`. If it ended the episode,
/// nothing follows, and `next` means nothing.
struct Experience {
  int state = 0, action = 0;
  double reward = 0;
  int next = 0;
  bool ended = false;
};

// Part 1, Q-learning (9:6 to 9:8).

/// An epsilon-greedy action: with probability `epsilon` any of the m actions, all equally likely; otherwise
/// the one of greatest `worth` (m), any of them with equal probability if several are equal.
int chosenAction(const Eigen::VectorXd& worth, double epsilon, rex::Rng& rng);

/// Actions chosen one after another. Given: it calls yours.
inline std::vector<int> choicesOf(const Eigen::VectorXd& worth, double epsilon, int count, rex::Rng& rng) {
  std::vector<int> choices;
  for (int i = 0; i < count; ++i) choices.push_back(chosenAction(worth, epsilon, rng));
  return choices;
}

/// Q after Q-learning from these steps, one after the other: each moves Q of its state and action by the
/// fraction `stepSize` towards the reward plus `discount` times the best current Q of the next state.
Eigen::MatrixXd qLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& steps, double stepSize,
                         double discount);

// Part 2, SARSA.

/// Q after SARSA from the steps of one episode, one after the other, as Q-learning, but with the value of the
/// action taken next instead of the best. After the last step, unless it ended the episode, the next
/// action is not known yet: nothing is learned from that step.
Eigen::MatrixXd sarsaLearned(const Eigen::MatrixXd& Q, const std::vector<Experience>& episode,
                             double stepSize, double discount);

// Part 3, a model.

/// A model estimated from experience. A pair that was never tried has zeros everywhere.
struct LearnedWorld {
  std::vector<Eigen::MatrixXd> P;  ///< m matrices (n x n): how likely a in s leads to t and does not end
  Eigen::MatrixXd R;               ///< n x m: the mean reward
  Eigen::MatrixXd visits;          ///< n x m: how often a was tried in s
};

/// The model of greatest likelihood: frequencies and means. Where episodes ended, rows of P sum to less than
/// one.
LearnedWorld estimated(const std::vector<Experience>& steps, int states, int actions);

/// Q of the best policy in the model, to 1e-6. Nothing follows an end, nor a pair that was never tried,
/// which is worth 0. The discount is at least 0 and below 1.
Eigen::MatrixXd plannedValues(const LearnedWorld& model, double discount);

// Part 4, R-max.

/// The same if each unknown pair is believed to pay `maxReward` in every step for ever. A pair is known if
/// it was tried at least `known` times; for known pairs, the model is used. No reward exceeds `maxReward`,
/// which is at least 0.
Eigen::MatrixXd optimisticValues(const LearnedWorld& model, int known, double maxReward, double discount);

// Part 5, imitation (9:9 to 9:11).

/// What a teacher did in a state.
struct Lesson {
  int state = 0, action = 0;
};

/// The policy (n x m) of a clone, P(a | s): the share of a among the actions of the lessons in s. In a state
/// without lessons, all actions are equally likely.
Eigen::MatrixXd cloned(const std::vector<Lesson>& lessons, int states, int actions);

/// P(t | s), n x n, if the action is drawn from `policy` (n x m), for a P as in LearnedWorld. Given.
inline Eigen::MatrixXd nextUnder(const std::vector<Eigen::MatrixXd>& P, const Eigen::MatrixXd& policy) {
  Eigen::MatrixXd next = Eigen::MatrixXd::Zero(policy.rows(), policy.rows());
  for (Eigen::Index a = 0; a < policy.cols(); ++a)
    next += policy.col(a).asDiagonal() * P[static_cast<std::size_t>(a)];
  return next;
}

/// Entry t (`steps` numbers, t = 0, 1, ...): the probability that step t is taken, and its action is not
/// that of the teacher, who always does `teacher`[s] in s. The first state is drawn from `start` (n), all
/// actions from `policy` (n x m), and P is as in LearnedWorld: no step follows an end.
Eigen::VectorXd mistakeChances(const std::vector<Eigen::MatrixXd>& P, const Eigen::VectorXd& start,
                               const Eigen::MatrixXd& policy, const std::vector<int>& teacher, int steps);

/// The policy of the clone after dataset aggregation (Ross, Gordon and Bagnell 2011). In each of `rounds`
/// rounds a clone of all lessons so far acts: `visited`(policy) are the states it comes to, maybe several
/// times. Each visit gives one lesson more: the teacher says what to do there, `taught`(s). The clone that
/// is returned has all lessons, also those of the last round.
Eigen::MatrixXd aggregated(const std::vector<Lesson>& lessons, int states, int actions, int rounds,
                           const std::function<std::vector<int>(const Eigen::MatrixXd& policy)>& visited,
                           const std::function<int(int state)>& taught);

// Part 6, inverse reinforcement learning (9:12 to 9:14).

/// A world without rewards.
struct FeatureWorld {
  std::vector<Eigen::MatrixXd> P;  ///< as in LearnedWorld
  Eigen::VectorXd start;           ///< n: how likely a walk starts in each state
  Eigen::MatrixXd features;        ///< k x n: phi(s) in column s
  double discount = 0;             ///< at least 0 and below 1
};

/// <phi> of 9:13 for a policy (n x m): the expectation of phi(s_0) + discount phi(s_1) + discount^2 phi(s_2)
/// + ... (k).
Eigen::VectorXd expectedFeatures(const FeatureWorld& world, const Eigen::MatrixXd& policy);

/// A policy (n x m) that is best in each state if each step from s pays w^T phi(s).
Eigen::MatrixXd bestPolicy(const FeatureWorld& world, const Eigen::VectorXd& w);

/// The share of `candidate`, between 0 and 1, in the mixture of it and `mixed` that is nearest to `teacher`
/// (k numbers each). 0 if both are equal.
double nearestShare(const Eigen::VectorXd& teacher, const Eigen::VectorXd& mixed,
                    const Eigen::VectorXd& candidate);

/// What a learner has found out about a teacher.
struct Explanation {
  std::vector<Eigen::MatrixXd> policies;  ///< the candidates of 9:13, in the order in which they were found
  Eigen::VectorXd shares;                 ///< one for each: how often the mixture follows it; their sum is 1
  Eigen::VectorXd w;                      ///< k: the weights for which the last policy is best, of length 1
};

/// The search of 9:13 by projections (Abbeel and Ng 2004). `teacher` (k) is the <phi> of the demonstrations.
/// The first policy chooses among all actions with equal probability, and has all of the mixture. In each
/// round, w points from the <phi> of the mixture to the teacher, a policy that is best under w is added, and
/// the mixture gives it the nearest share; the shares of all others shrink in proportion. This ends after
/// `rounds` rounds, or as soon as the mixture is no farther than `tolerance` from the teacher: without any
/// round, w is zero.
Explanation explained(const FeatureWorld& world, const Eigen::VectorXd& teacher, int rounds,
                      double tolerance);

// Part 7, a bonus: bandits (6:22).

/// An optimistic estimate of what each arm of a bandit pays on average, its upper confidence bound (m): the
/// mean payment plus a margin b. Payments are between 0 and 1; arm k was pulled N_k = `pulls`[k] times, at
/// least once, and paid `paid`[k] in total. After n pulls, of all arms together, b is such that Hoeffding's
/// inequality, P(true mean > mean + b) <= exp(-2 N_k b^2), allows n^-4. The bound may exceed 1.
Eigen::VectorXd upperBounds(const Eigen::VectorXi& pulls, const Eigen::VectorXd& paid);
