// caught by: hamiltonian, other-regulators
// mistake: the Hamiltonian matrix of R = 1.

// <solution viaHamiltonian>
const Eigen::Index n = plant.A.rows();
Eigen::MatrixXd Z(2 * n, 2 * n);
Z << plant.A, -plant.B *plant.B.transpose(), -costs.Q, -plant.A.transpose();
for (int k = 0; k < 60; ++k) Z = (.5 * (Z + inverse(Z))).eval();
Z += Eigen::MatrixXd::Identity(2 * n, 2 * n);
Eigen::MatrixXd P(n, n);
for (Eigen::Index i = 0; i < n; ++i) P.col(i) = leastSquares(Z.rightCols(n), -Z.col(i));
return .5 * (P + P.transpose());
// </solution>
