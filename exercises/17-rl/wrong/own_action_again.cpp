// caught by: sarsa-steps, more-episodes
// mistake: takes the action of the step itself in the next state.

// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (!step.ended && t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned(step.next, step.action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
