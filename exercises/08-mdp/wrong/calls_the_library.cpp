// caught by: forbidden-call
// mistake: asks the library for the optimal policy.

// <solution headers>
#include "learning/dynamic_programming.h"
// </solution>

// <solution iteratePolicies>
Mdp mdp{.rewards = process.R, .discount = process.discount};
for (const Eigen::MatrixXd& P : process.P) mdp.transitions.push_back(P.sparseView());
for (Eigen::Index s = 0; s < process.R.rows(); ++s) mdp.terminal.push_back(process.P[0].row(s).isZero());
return {std::vector<int>(mdp.terminal.size(), 0), policyIteration(mdp).actions};
// </solution>
