// caught by: observer, other-sensors
// mistake: what C alone does not show, without the derivatives of y.

// <solution unseen>
const Eigen::MatrixXd V = svd(Eigen::MatrixXd(C.transpose())).U, all = V * V.transpose();
const SingularValues rest = svd(Eigen::MatrixXd::Identity(A.rows(), A.rows()) - all);
return rest.U.leftCols(A.rows() - C.rows());
// </solution>
