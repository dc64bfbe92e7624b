// caught by: gain, unseen-lqr
// mistake: the sign of the gain as on slide 8:43, where u = +K x.

// <solution lqrGain>
Eigen::MatrixXd Z(8, 8);
Z << system.A, -system.B *system.B.transpose() / R, -Q, -system.A.transpose();
for (int i = 0; i < 60; ++i) Z = (Z + inverse(Z)).eval() / 2;
Z.diagonal().array() += 1;
Eigen::Vector4d K;
for (int i = 0; i < 4; ++i) K[i] = -system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i))) / R;
return K;
// </solution>
