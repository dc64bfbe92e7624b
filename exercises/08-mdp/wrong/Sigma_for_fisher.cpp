// caught by: natural, linear-returns, other-features
// mistake: takes the metric of the noise for that of the policy.

// <solution naturalGradientOf>
const Eigen::MatrixXd Sigma = policy.L * policy.L.transpose();
return solve(Sigma, reinforce(policy, trials, discount));
// </solution>
