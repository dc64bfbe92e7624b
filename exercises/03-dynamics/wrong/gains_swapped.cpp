// caught by: point-regimes, point-any-mass, follow-cosine
// mistake: Kp and Kd are swapped.

// <solution gainsFor>
// The slower of the two rates of decay decides when the point is there: rate * T = 8 leaves 0.3 % also
// where two equal rates add a factor of T.
double xi = 1, lambda = T / 8;
if (regime == Regime::kOscillatory) {
  xi = 0.5;
  lambda = xi * T / 8;
}
if (regime == Regime::kOverdamped) {
  xi = 1.5;
  lambda = (xi - std::sqrt(xi * xi - 1)) * T / 7;
}
return {2 * mass * xi / lambda, mass / (lambda * lambda)};
// </solution>
