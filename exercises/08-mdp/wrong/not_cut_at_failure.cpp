// caught by: trials
// mistake: goes on after a failure.

// <solution runTrial>
const auto k = static_cast<int>(start.size());
Rollout trial{Eigen::MatrixXd(k, horizon), Eigen::MatrixXd(k, horizon), Eigen::VectorXd(horizon)};
Eigen::VectorXd state = start;
for (int t = 0; t < horizon; ++t) {
  trial.features.col(t) = state;
  trial.noise.col(t) = policy.L * rng.normalVector(k);
  const Transition outcome = step(state, state.dot(policy.beta + trial.noise.col(t)));
  trial.rewards[t] = outcome.reward;
  state = outcome.next;
}
return trial;
// </solution>
