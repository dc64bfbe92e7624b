// caught by: poles, other-fates
// mistake: slide 8:36 as printed: no positive real part, so nothing grows.

// <solution fateOf>
const double slowest = eigenvalues(A).real().maxCoeff();
return slowest > 1e-5 ? Fate::grows : slowest < -1e-5 ? Fate::dies : Fate::stays;
// </solution>
