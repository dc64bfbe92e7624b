// caught by: sums, other-robots
// mistake: The distance to an upper limit has the wrong sign.

// <solution jointLimits>
for (Eigen::Index i = 0; i < q.size(); ++i) {
  const double below = margin - q[i] + low[i], above = margin - q[i] + high[i];
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
