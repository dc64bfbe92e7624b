// caught by: priority-second, priority-any
// mistake: The last line of slide 2:50 without a: the second task is not fulfilled although it could be.

// <solution priorityStep>
const auto pseudoInverse = [](const Eigen::MatrixXd& J) {
  const SingularValues parts = svd(J);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
  return inverse;
};
return pseudoInverse(J1) * dy1 + nullspaceProjector(J1) * pseudoInverse(J2) * dy2;
// </solution>
