// caught by: returns, gradient
// mistake: also sums the rewards before the step.

// <solution returnsToGo>
double sum = 0, weight = 1;
for (const double reward : rewards) {
  sum += weight * reward;
  weight *= discount;
}
return Eigen::VectorXd::Constant(rewards.size(), sum);
// </solution>
