#pragma once

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

// Part 5, a bonus: bandits (6:22).

/// An optimistic estimate of what each arm of a bandit pays on average, its upper confidence bound (m): the
/// mean payment plus a margin b. Payments are between 0 and 1; arm k was pulled N_k = `pulls`[k] times, at
/// least once, and paid `paid`[k] in total. After n pulls, of all arms together, b is such that Hoeffding's
/// inequality, P(true mean > mean + b) <= exp(-2 N_k b^2), allows n^-4. The bound may exceed 1.
Eigen::VectorXd upperBounds(const Eigen::VectorXi& pulls, const Eigen::VectorXd& paid);
