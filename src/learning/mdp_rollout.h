#pragma once

#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

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
