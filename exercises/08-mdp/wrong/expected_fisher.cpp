// caught by: natural, linear-returns
// mistake: takes the expectation of F over the actions.

// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    F += std::pow(discount, t) / variance * phi * phi.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));
// </solution>
