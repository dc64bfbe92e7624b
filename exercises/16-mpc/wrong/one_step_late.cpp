// caught by: predict, more-predictions
// mistake: the effect of a control is one power of A too high.

// <solution predicted>
Eigen::MatrixXd power = plant.A;
for (int age = 0; age < N; ++age, power = (plant.A * power).eval()) {
  p.Sx.middleRows(age * n, n) = power;
  for (int k = 0; k + age < N; ++k) p.Su.block((k + age) * n, k * m, n, m) = power * plant.B;
}
// </solution>
