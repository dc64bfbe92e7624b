// caught by: outings
// mistake: goes on after the fall.

// <solution balanced>
Eigen::MatrixXd states(4, outing.steps + 1);
states.col(0) = start;
for (int t = 0; t < outing.steps; ++t) {
  const Eigen::Vector4d x = states.col(t);
  states.col(t + 1) = stepped(cart, x, K.row(0).dot(x), outing.tau, outing.noise, rng);
}
return states;
// </solution>
