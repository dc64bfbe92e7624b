// caught by: loops, other-sensors
// mistake: the observer does not know u.

// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, realBK = real.B * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A, realBK, LC, model.A - LC;
return loop;
// </solution>
