// caught by: observer, other-sensors
// mistake: the sign of K is kept for L.

// <solution observerGain>
const Plant dual{A.transpose(), C.transpose()};
const Costs costs{noise.W, noise.V};
return gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();
// </solution>
