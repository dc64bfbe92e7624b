// caught by: gradient
// shown by: gradient
// mistake: the discount of the step itself is missing.

// <solution reinforce>
Eigen::VectorXd sum = Eigen::VectorXd::Zero(policy.beta.size());
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  for (Eigen::Index t = 0; t < Q.size(); ++t) {
    const Eigen::VectorXd phi = trial.features.col(t);
    sum += Q[t] * phi.dot(trial.noise.col(t)) / (policy.L.transpose() * phi).squaredNorm() * phi;
  }
}
return sum / static_cast<double>(trials.size());
// </solution>
