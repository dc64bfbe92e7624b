// caught by: forces, lagrangian
// mistake: the sign of the potential energy, as if the pendulum hung.

// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
return {-swing * v[1] * v[1], swing* racer.g};
// </solution>
