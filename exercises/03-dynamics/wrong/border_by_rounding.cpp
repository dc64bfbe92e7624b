// caught by: pid-stability
// mistake: Eigenvalues are compared with zero, so that rounding decides on the border.

// <solution isStable>
if (gains.Ki == 0) return gains.Kp > 0 && gains.Kd > 0;
Eigen::MatrixXd A(3, 3);
A << 0, 1, 0, 0, 0, 1, -gains.Ki / mass, -gains.Kp / mass, -gains.Kd / mass;
return eigenvalues(A).real().maxCoeff() < 0;
// </solution>
