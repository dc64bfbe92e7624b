// caught by: observer, other-sensors
// mistake: L = S C^T, without V.

// <solution observerGain>
const Eigen::MatrixXd S = viaHamiltonian({A.transpose(), C.transpose()}, {noise.W, noise.V});
return S * C.transpose();
// </solution>
