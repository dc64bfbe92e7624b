// caught by: trials
// shown by: trials
// mistake: notes the state that the step led to.

// <solution runTrial>
const auto k = static_cast<int>(start.size());
Rollout trial{Eigen::MatrixXd(k, horizon), Eigen::MatrixXd(k, horizon), Eigen::VectorXd(horizon)};
Eigen::VectorXd state = start;
int t = 0;
for (bool goesOn = true; goesOn && t < horizon; ++t) {
  trial.noise.col(t) = policy.L * rng.normalVector(k);
  const Transition outcome = step(state, state.dot(policy.beta + trial.noise.col(t)));
  trial.rewards[t] = outcome.reward;
  trial.features.col(t) = state = outcome.next;
  goesOn = !outcome.failed;
}
return {trial.features.leftCols(t), trial.noise.leftCols(t), trial.rewards.head(t)};
// </solution>
