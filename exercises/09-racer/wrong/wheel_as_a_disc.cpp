// caught by: mass, lagrangian
// mistake: takes mA r^2 / 4 for the wheel's moment of inertia; for the racer of the sheet that is IA.

// <solution massMatrix>
const double IA = racer.mA * racer.r * racer.r / 4, c = racer.mB * racer.l * std::cos(q[1]);
Eigen::Matrix2d M;
M << racer.mA + racer.mB + IA / (racer.r * racer.r), c, c, racer.IB + racer.mB* racer.l* racer.l;
return M;
// </solution>
