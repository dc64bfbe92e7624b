// caught by: loops, other-sensors
// mistake: the observer subtracts L (y - C x^).

// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, modelBK = model.B * K, realBK = real.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A, realBK, -LC, model.A + modelBK + LC;
return loop;
// </solution>
