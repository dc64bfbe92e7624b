// caught by: priority-first
// mistake: where the tasks disagree, J2 N1 is only rounding error, but is taken for freedom to move

// <solution priorityStep>
const auto pseudoInverse = [](const Eigen::MatrixXd& J) {
  const SingularValues parts = svd(J);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
  return inverse;
};
const Eigen::VectorXd first = pseudoInverse(J1) * dy1;
return first + pseudoInverse(J2 * nullspaceProjector(J1)) * (dy2 - J2 * first);
// </solution>
