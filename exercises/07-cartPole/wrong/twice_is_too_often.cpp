// caught by: poles, other-fates
// mistake: every eigenvalue on the axis that occurs twice lets motions grow.

// <solution fateOf>
const Eigen::VectorXcd poles = eigenvalues(A);
if (poles.real().maxCoeff() > 1e-5) return Fate::grows;
Fate fate = Fate::dies;
for (const std::complex<double>& pole : poles) {
  if (pole.real() < -1e-5) continue;
  if (fate == Fate::dies) fate = Fate::stays;
  int times = 0;
  for (const std::complex<double>& other : poles) times += std::abs(other - pole) < 1e-4;
  if (times > 1) fate = Fate::grows;
}
return fate;
// </solution>
