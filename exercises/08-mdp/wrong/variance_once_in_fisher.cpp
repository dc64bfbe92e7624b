// caught by: natural, linear-returns
// shown by: natural
// mistake: divides by the variance once instead of twice in F.

// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials)
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    const double moved = phi.dot(trial.noise.col(t));
    F += std::pow(discount, t) * moved * moved / variance * phi * phi.transpose();
  }
return solve(F / static_cast<double>(trials.size()), reinforce(policy, trials, discount));
// </solution>
