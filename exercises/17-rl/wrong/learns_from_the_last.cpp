// caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: learns from the last step as if nothing followed.

// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  const bool isLast = t + 1 == episode.size();
  const double later = isLast ? 0 : learned(step.next, episode[t + 1].action);
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
