// caught by: predict, more-predictions
// mistake: rows and columns of the blocks are mixed up.

// <solution predicted>
Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n);
for (int age = 0; age < N; ++age, power = (plant.A * power).eval()) {
  p.Sx.middleRows(age * n, n) = plant.A * power;
  for (int t = 0; t + age < N; ++t) p.Su.block(t * n, (t + age) * m, n, m) = power * plant.B;
}
// </solution>
