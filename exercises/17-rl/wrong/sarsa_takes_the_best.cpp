// caught by: sarsa-steps, more-episodes
// shown by: sarsa-steps
// mistake: is Q-learning.

// <solution sarsaLearned>
Eigen::MatrixXd learned = Q;
for (std::size_t t = 0; t < episode.size(); ++t) {
  const Experience& step = episode[t];
  if (!step.ended && t + 1 == episode.size()) break;
  const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
