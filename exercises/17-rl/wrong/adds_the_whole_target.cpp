// caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the target and not the difference from it.

// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = step.ended ? 0 : learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later);
}
return learned;
// </solution>
