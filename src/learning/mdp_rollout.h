#pragma once

#include <vector>

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// The state after action a in s; s must not be terminal, and the process be one that requireMdp accepts.
[[nodiscard]] int sampledNext(const Mdp& mdp, int s, int a, Rng& rng);
/// An action of the policy in state s.
[[nodiscard]] int sampledAction(const MatrixArg& policy, int s, Rng& rng);

/// What happened: in states[t], actions[t] was taken.
struct MdpEpisode {
  std::vector<int> states{}, actions{};
  double discountedReturn = 0;  ///< sum_t discount^t R(s_t, a_t)
  bool ended = false;           ///< in a terminal state, not cut off
};
/// Throws Error as requireMdp and requirePolicy, for an unknown start, and unless maxSteps is positive.
[[nodiscard]] MdpEpisode mdpEpisode(const Mdp& mdp, const MatrixArg& policy, int start, int maxSteps,
                                    Rng& rng);

struct ReturnEstimate {
  double mean = 0;
  double standardError = 0;  ///< of the mean
  int cut = 0;               ///< episodes that had not ended after maxSteps
};
/// The return from a state by many episodes. Throws Error as mdpEpisode, and for less than two episodes.
[[nodiscard]] ReturnEstimate estimatedReturn(const Mdp& mdp, const MatrixArg& policy, int start, int episodes,
                                             int maxSteps, Rng& rng);

}  // namespace rex
