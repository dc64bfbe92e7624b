// caught by: natural, linear-returns
// mistake: makes F of the sums over whole trials.

// <solution naturalGradientOf>
const Eigen::Index k = policy.beta.size();
Eigen::MatrixXd F = Eigen::MatrixXd::Zero(k, k);
for (const Rollout& trial : trials) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(k);
  for (Eigen::Index t = 0; t < trial.rewards.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    const double variance = (policy.L.transpose() * phi).squaredNorm();
    sum += std::pow(discount, t) * phi.dot(trial.noise.col(t)) / variance * phi;
  }
  F += sum * sum.transpose() / static_cast<double>(trials.size());
}
return solve(F, reinforce(policy, trials, discount));
// </solution>
