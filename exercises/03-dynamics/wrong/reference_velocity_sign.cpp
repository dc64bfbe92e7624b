// caught by: follow-cosine
// mistake: the velocity of the reference has the wrong sign.

// <solution followForce>
const PointState reference{std::cos(t), std::sin(t)};
return mass * -std::cos(t) + pdForce(at, reference, gainsFor(regime, 1, mass));
// </solution>
