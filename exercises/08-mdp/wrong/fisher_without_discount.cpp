// caught by: natural, linear-returns
// shown by: natural
// mistake: leaves discount^t out of F.

// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const Eigen::VectorXd slope = phi.dot(trial.noise.col(t)) / variance * phi;
    F += slope * slope.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));
// </solution>
