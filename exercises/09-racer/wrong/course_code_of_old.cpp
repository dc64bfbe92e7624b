// caught by: forces, lagrangian
// mistake: the terms of the course's old code: one Coriolis term twice, and another that does not exist.

// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
const double second = swing * v[0] * v[1] - swing * racer.g;
return {-2 * swing * v[1] * v[1], second};
// </solution>
