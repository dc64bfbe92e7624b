// caught by: noise
// mistake: draws from a copy of rng, which itself never moves on: each run has the same noise.

// <solution kicks>
Rng mine = rng;
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t) noises.col(t) = std::sqrt(tau) * noise * mine.normalVector(2);
return noises;
// </solution>
