// caught by: point-regimes, point-any-mass
// mistake: lambda is taken for the time until the goal is reached.

// <solution gainsFor>
const double xi = regime == Regime::kCritical ? 1 : regime == Regime::kOscillatory ? 0.5 : 1.5;
return {mass / (T * T), 2 * mass* xi / T};
// </solution>
