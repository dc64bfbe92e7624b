// caught by: projector
// mistake: Singular values below a thousandth count as zero, however small the others are.

// <solution nullspaceProjector>
const SingularValues parts = svd(J);
Eigen::MatrixXd N = Eigen::MatrixXd::Identity(J.cols(), J.cols());
for (Eigen::Index i = 0; i < parts.s.size(); ++i)
  if (parts.s[i] > 1e-3) N -= parts.V.col(i) * parts.V.col(i).transpose();
return N;
// </solution>
