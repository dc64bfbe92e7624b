// caught by: gain, unseen-lqr
// mistake: forgets R, which is 1 on the sheet.

// <solution lqrGain>
Eigen::MatrixXd Z(8, 8);
Z << system.A, -system.B *system.B.transpose(), -Q, -system.A.transpose();
for (int i = 0; i < 60; ++i) Z = (Z + inverse(Z)).eval() / 2;
Z.diagonal().array() += 1;
Eigen::Vector4d K;
for (int i = 0; i < 4; ++i) K[i] = system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i)));
return K;
// </solution>
