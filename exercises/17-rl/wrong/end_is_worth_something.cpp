// caught by: q-steps, more-steps
// shown by: q-steps
// mistake: adds the values of the next state after the end.

// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = learned.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
