// caught by: sarsa-steps, more-episodes
// mistake: leaves out the last step even if it ended the episode.

// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned(step.next, episode[t + 1].action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
