// caught by: sums, other-robots
// mistake: Only joints beyond their limits cost anything.

// <solution jointLimits>
for (Eigen::Index i = 0; i < q.size(); ++i) {
  const double below = low[i] - q[i], above = q[i] - high[i];
  if (below > 0) {
    y[0] += below / margin;
    J(0, i) -= 1 / margin;
  }
  if (above > 0) {
    y[0] += above / margin;
    J(0, i) += 1 / margin;
  }
}
// </solution>
