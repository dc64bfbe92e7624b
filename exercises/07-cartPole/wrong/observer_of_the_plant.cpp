// caught by: observer, other-sensors
// mistake: A is not transposed in the dual plant.

// <solution observerGain>
const Plant dual{A, C.transpose()};
const Costs costs{noise.W, noise.V};
return -gainOf(dual, costs, viaHamiltonian(dual, costs)).transpose();
// </solution>
