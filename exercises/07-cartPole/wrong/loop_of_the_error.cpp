// caught by: loops, other-sensors
// mistake: the matrix of (x, x - x^), as in the proof of the separation principle.

// <solution observedLoop>
const Eigen::MatrixXd LC = L * C, BK = real.B * K, gap = (model.B - real.B) * K;
Eigen::MatrixXd loop(2 * LC.rows(), 2 * LC.rows());
loop << real.A + BK, -BK, real.A - model.A - gap, model.A - LC + gap;
return loop;
// </solution>
