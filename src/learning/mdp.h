#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/require.h"
#include "base/rng.h"

namespace rex {

/// The transitions of one action: entry (s, t) is P(next = t | s), states x states. Convert a dense matrix
/// with sparseView().
using TransitionMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// A stationary Markov decision process with finitely many states and actions, slide 9:4. Acting in a state
/// gives a reward; a terminal state ends the process.
struct Mdp {
  std::vector<TransitionMatrix> transitions{};  ///< one for each action; rows of terminal states are empty
  Eigen::MatrixXd rewards{};                    ///< states x actions: E{r | s, a}
  double discount = .9;                         ///< in [0, 1]
  std::vector<bool> terminal{};                 ///< one for each state; empty: none ends

  int states() const { return static_cast<int>(rewards.rows()); }
  int actions() const { return static_cast<int>(rewards.cols()); }
  bool isTerminal(int s) const { return !terminal.empty() && terminal[static_cast<std::size_t>(s)]; }
};

/// Throws Error for sizes that do not fit, a discount outside [0, 1], rewards and probabilities that are not
/// finite, negative probabilities, and rows that do not sum to one within 1e-9, naming action and state.
void requireMdp(const Mdp& mdp);

/// The transitions as dense matrices.
[[nodiscard]] std::vector<Eigen::MatrixXd> denseTransitions(const Mdp& mdp);

/// R(s, a) if `entered`[t] is paid for entering state t: states x actions. Throws Error for sizes that do
/// not fit.
[[nodiscard]] Eigen::MatrixXd rewardsOnEntering(const std::vector<TransitionMatrix>& transitions,
                                                const VectorArg& entered);

/// A policy is a matrix, states x actions, of probabilities pi(a | s). Throws Error for sizes that do not
/// fit, negative or infinite entries, and rows that do not sum to one within 1e-9.
void requirePolicy(const Mdp& mdp, const MatrixArg& policy);
/// All actions equally likely.
[[nodiscard]] Eigen::MatrixXd uniformPolicy(const Mdp& mdp);
/// The deterministic policy that takes actions[s] in state s. Throws Error for a wrong number of states or
/// an unknown action.
[[nodiscard]] Eigen::MatrixXd deterministicPolicy(const Mdp& mdp, const std::vector<int>& actions);
/// The best action of each state with probability 1 - epsilon, otherwise a random one. Throws like
/// greedyActions, and Error unless epsilon is in [0, 1].
[[nodiscard]] Eigen::MatrixXd epsilonGreedy(const MatrixArg& Q, double epsilon);

/// Q(s, a) = R(s, a) + discount sum_t P(t | s, a) V(t): states x actions, the bracket of eq. (10) of
/// exercise 12.10. Throws Error for a V of the wrong size.
[[nodiscard]] Eigen::MatrixXd actionValues(const Mdp& mdp, const VectorArg& V);
/// The best action in each state, the first if several are equal. Throws Error if there is no action.
[[nodiscard]] std::vector<int> greedyActions(const MatrixArg& Q);

enum class MdpStatus {
  kSolved,
  kNotConverged,  ///< the error bound is still above the tolerance
  kEndless        ///< undiscounted, and the policy may go on forever: there is no value
};

/// Draws the state after action a in s. The state s must not be terminal, and `mdp` must be valid
/// (requireMdp).
[[nodiscard]] int sampledNext(const Mdp& mdp, int s, int a, Rng& rng);
/// Draws an action of the policy in state s.
[[nodiscard]] int sampledAction(const MatrixArg& policy, int s, Rng& rng);

/// One episode: in states[t], actions[t] was taken.
struct MdpEpisode {
  std::vector<int> states{}, actions{};
  double discountedReturn = 0;  ///< sum_t discount^t R(s_t, a_t)
  bool ended = false;           ///< in a terminal state, not truncated
};
/// Throws Error like requireMdp and requirePolicy, for an unknown start, and unless maxSteps is positive.
[[nodiscard]] MdpEpisode mdpEpisode(const Mdp& mdp, const MatrixArg& policy, int start, int maxSteps,
                                    Rng& rng);

struct ReturnEstimate {
  double mean = 0;
  double standardError = 0;  ///< of the mean
  int cut = 0;               ///< episodes that had not ended after maxSteps
};
/// Estimates the return from a state with many episodes. Throws Error like mdpEpisode, and for fewer than
/// two episodes.
[[nodiscard]] ReturnEstimate estimatedReturn(const Mdp& mdp, const MatrixArg& policy, int start, int episodes,
                                             int maxSteps, Rng& rng);

}  // namespace rex
