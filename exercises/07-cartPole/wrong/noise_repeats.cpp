// caught by: outings
// mistake: each step gets a copy of the generator, and so the same noise.

// <solution balanced>
Eigen::MatrixXd states(4, outing.steps + 1);
states.col(0) = start;
int t = 0;
while (t < outing.steps && std::abs(states(2, t)) <= std::numbers::pi / 2) {
  const Eigen::Vector4d before = states.col(t);
  Rng own = rng;
  states.col(++t) = stepped(cart, before, K.row(0).dot(before), outing.tau, outing.noise, own);
}
return states.leftCols(t + 1);
// </solution>
