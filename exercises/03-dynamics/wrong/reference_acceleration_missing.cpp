// caught by: follow-cosine
// mistake: PD control alone: on the reference there is no force, so the point lags behind.

// <solution followForce>
return pdForce(at, {std::cos(t), -std::sin(t)}, gainsFor(regime, 1, mass));
// </solution>
