// caught by: loops, other-sensors
// mistake: the observer moves as the plant does, not as its model.

// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, BK = real.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A, BK, LC, real.A + BK - LC;
return loop;
// </solution>
