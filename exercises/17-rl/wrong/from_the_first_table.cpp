// caught by: q-steps, more-steps
// mistake: takes the best of the next state by the Q from before all steps.

// <solution qLearned>
Eigen::MatrixXd learned = Q;
for (const Experience& step : steps) {
  const double later = step.ended ? 0 : Q.row(step.next).maxCoeff();
  double& q = learned(step.state, step.action);
  q += stepSize * (step.reward + discount * later - q);
}
return learned;
// </solution>
