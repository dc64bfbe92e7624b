// caught by: mass, lagrangian
// mistake: the wheel moves along, but does not turn.

// <solution massMatrix>
const double mixed = racer.mB * racer.l * std::cos(q[1]);
Eigen::Matrix2d M;
M << racer.mA + racer.mB, mixed, mixed, racer.mB* racer.l* racer.l + racer.IB;
return M;
// </solution>
