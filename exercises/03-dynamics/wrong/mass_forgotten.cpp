// caught by: point-regimes, point-any-mass
// mistake: the gains are those for a point of 1 kg.

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
return {1 / (lambda * lambda), 2 * xi / lambda};
// </solution>
