// caught by: predict, more-predictions
// shown by: predict
// mistake: the first rows are those of x_0.

// <solution predicted>
p.Sx.topRows(n) = Eigen::MatrixXd::Identity(n, n);
p.Su.topLeftCorner(n, m) = plant.B;
for (int t = 1; t < N; ++t) {
  p.Sx.middleRows(t * n, n) = plant.A * p.Sx.middleRows((t - 1) * n, n);
  p.Su.middleRows(t * n, n) = plant.A * p.Su.middleRows((t - 1) * n, n);
  p.Su.block(t * n, t * m, n, m) = plant.B;
}
// </solution>
