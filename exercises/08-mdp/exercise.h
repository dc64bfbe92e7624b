#pragma once

#include <functional>
#include <vector>

#include "course/course.h"

// The functions you complete in main.cpp. n is the number of states, m that of actions, k that of features;
// states and actions are counted from 0. Slides are named as chapter:number.

// Part 1, the T-maze (12.10.1 b, c), by hand.

/// Values of its states s1 to s7, in this order: 7 numbers each.
struct MazeValues {
  Eigen::VectorXd random;   ///< going left or right with equal probability
  Eigen::VectorXd optimal;  ///< taking the best action
};

/// From the junction s1 one goes left to s2 or right to s3, from s2 to s4 or s5, from s3 to s6 or s7. There
/// are no rewards on the way; s4 to s7 give the `leaves` (4 numbers) as rewards and are terminal. In 12.10
/// the leaves are 4, 0, 2, 3 and the discount is .5; here they may have any values.
MazeValues mazeValues(const Eigen::VectorXd& leaves, double discount);

// Parts 2 to 4, processes of finitely many states (9:4, 12.10.1).

/// In each state one takes an action, receives the reward R(s, a) and moves on to the next state. Nothing
/// follows a terminal state: its row of P is zero for all actions. All other rows sum to 1.
struct Process {
  std::vector<Eigen::MatrixXd> P;  ///< m matrices (n x n): P[a](s, t) is the probability of t after a in s
  Eigen::MatrixXd R;               ///< n x m
  double discount = 0.9;           ///< at least 0 and below 1
};

/// The values V (n) of a policy, eq. (9). Entry (s, a) of `policy` (n x m) is the probability of a in s.
/// Exact up to 1e-9 of the largest value.
Eigen::VectorXd valuesOf(const Process& process, const Eigen::MatrixXd& policy);

/// The bracket of eq. (10) for each state and action, with V* in place of the V^pi on the sheet (n x m).
Eigen::MatrixXd worthOfActions(const Process& process, const Eigen::VectorXd& V);

/// Value iteration: V_0 = 0 and V_1, V_2, ..., each computed from the one before by eq. (10). Ends with the
/// first V_k for which discount / (1 - discount) times the greatest change since V_(k-1) is at most
/// `tolerance` (above 1e-9): then V_k is within `tolerance` of V* in every state.
std::vector<Eigen::VectorXd> iterateValues(const Process& process, double tolerance);

/// Policy iteration: policies as one action for each state. The first takes action 0 everywhere. Each
/// further one takes in every state an action that is best by the values of the one before, and keeps its
/// action where that is as good (up to 1e-9 of the greatest value). The last policy is the one that no
/// longer changes; it is listed once.
std::vector<std::vector<int>> iteratePolicies(const Process& process);

// Parts 5 to 8, policies with noise and rollouts (9:16, 9:17, 12.10.1 d).

/// The action in a state s is a = phi(s)^T (beta + epsilon), with an epsilon ~ N(0, Sigma), Sigma = L L^T,
/// drawn again in each step. Here the features phi(s) are the state itself.
struct Policy {
  Eigen::VectorXd beta;  ///< k
  Eigen::MatrixXd L;     ///< k x k, invertible
};

/// A trial of T steps to learn from, one column per step.
struct Rollout {
  Eigen::MatrixXd features;  ///< k x T: phi(s_t)
  Eigen::MatrixXd noise;     ///< k x T: epsilon_t
  Eigen::VectorXd rewards;   ///< T
};

/// The result of a step. If it failed, the trial ends, and this reward is the last.
struct Transition {
  Eigen::VectorXd next;
  double reward = 0;
  bool failed = false;
};
using StepFunction = std::function<Transition(const Eigen::VectorXd& state, double action)>;

/// Runs the policy from `start` for `horizon` steps, or fewer if one fails. Draws the epsilon of each step
/// from rng.normalVector(k).
Rollout runTrial(const StepFunction& step, const Eigen::VectorXd& start, const Policy& policy, int horizon,
                 rex::Rng& rng);

/// Q_t = sum over t' >= t of discount^(t' - t) r_t', for each step (T): 9:17.
Eigen::VectorXd returnsToGo(const Eigen::VectorXd& rewards, double discount);

/// REINFORCE (9:17): the mean over trials of sum_t discount^t Q_t (d/dbeta log pi(a_t | s_t)), k numbers,
/// with no baseline. log pi is that of 9:16. No phi is zero.
Eigen::VectorXd reinforce(const Policy& policy, const std::vector<Rollout>& trials, double discount);

/// The new beta (k) of PoWER, for any number of features: 12.10.1 d with W = phi phi^T / (phi^T Sigma phi)
/// and epsilon_t for its e_t. All Q_t are positive, and the features of the trials are not all in one plane.
Eigen::VectorXd power(const Policy& policy, const std::vector<Rollout>& trials, double discount);

// Part 8, a bonus: the natural gradient (9:17).

/// w = F^-1 g (k) with the g of `reinforce`. F is the mean over trials of sum_t discount^t (d/dbeta log
/// pi(a_t | s_t)) (d/dbeta log pi(a_t | s_t))^T, and invertible. Exact up to a millionth of the length of w.
Eigen::VectorXd naturalGradientOf(const Policy& policy, const std::vector<Rollout>& trials, double discount);
