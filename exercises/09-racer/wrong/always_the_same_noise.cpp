// caught by: noise
// mistake: uses a generator of its own, so that all rides have the same noise.

// <solution kicks>
Rng own(3);
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t)
  for (int i = 0; i < 2; ++i) noises(i, t) = std::sqrt(tau) * noise * own.normal();
return noises;
// </solution>
