#pragma once

#include "base/rng.h"
#include "learning/mdp.h"

namespace rex {

/// Each row has about `reach` successors; with `terminals`, the last so many states end.
inline Mdp randomMdp(int states, int actions, double discount, Rng& rng, int terminals = 0, int reach = 3) {
  Mdp mdp;
  mdp.discount = discount;
  mdp.rewards.resize(states, actions);
  mdp.terminal.assign(static_cast<std::size_t>(states), false);
  for (int s = states - terminals; s < states; ++s) mdp.terminal[static_cast<std::size_t>(s)] = true;
  for (int a = 0; a < actions; ++a) {
    Eigen::MatrixXd P = Eigen::MatrixXd::Zero(states, states);
    for (int s = 0; s < states; ++s) {
      mdp.rewards(s, a) = rng.normal();
      if (mdp.isTerminal(s)) continue;
      for (int i = 0; i < reach; ++i) P(s, rng.index(states)) += rng.uniform(.1, 1);
      if (terminals > 0) P(s, states - 1 - rng.index(terminals)) += .1;
      P.row(s) /= P.row(s).sum();
    }
    mdp.transitions.push_back(P.sparseView());
  }
  return mdp;
}

inline Eigen::MatrixXd randomPolicy(const Mdp& mdp, Rng& rng) {
  Eigen::MatrixXd policy(mdp.states(), mdp.actions());
  for (int s = 0; s < mdp.states(); ++s) {
    policy.row(s) = rng.uniformVector(mdp.actions(), 0, 1).transpose();
    policy.row(s) /= policy.row(s).sum();
  }
  return policy;
}

}  // namespace rex
