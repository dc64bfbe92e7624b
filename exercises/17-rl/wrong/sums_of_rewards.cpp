// caught by: estimate, unseen-map
// shown by: estimate
// mistake: does not divide the sums of rewards.

// <solution estimated>
LearnedWorld model;
model.R = model.visits = Eigen::MatrixXd::Zero(states, actions);
model.P.assign(static_cast<std::size_t>(actions), Eigen::MatrixXd::Zero(states, states));
for (const Experience& step : steps) {
  model.visits(step.state, step.action) += 1;
  model.R(step.state, step.action) += step.reward;
  if (!step.ended) model.P[static_cast<std::size_t>(step.action)](step.state, step.next) += 1;
}
for (int s = 0; s < states; ++s)
  for (int a = 0; a < actions; ++a) {
    const double tries = std::max(1., model.visits(s, a));
    model.P[static_cast<std::size_t>(a)].row(s) /= tries;
  }
return model;
// </solution>
