// caught by: predict, more-predictions
// mistake: a control acts on the next state only.

// <solution predicted>
Eigen::MatrixXd power = plant.A;
for (int t = 0; t < N; ++t, power = (power * plant.A).eval()) {
  p.Sx.middleRows(t * n, n) = power;
  p.Su.block(t * n, t * m, n, m) = plant.B;
}
// </solution>
