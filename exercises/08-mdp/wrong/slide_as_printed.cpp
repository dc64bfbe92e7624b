// caught by: power, more-power
// mistake: the ratio of slide 9:17, which is right for one feature.

// <solution power>
Eigen::VectorXd moves = Eigen::VectorXd::Zero(policy.beta.size());
double weights = 0;
for (const Rollout& trial : trials) {
  const Eigen::VectorXd Q = returnsToGo(trial.rewards, discount);
  moves += trial.noise * Q;
  weights += Q.sum();
}
return policy.beta + moves / weights;
// </solution>
