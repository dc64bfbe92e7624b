// caught by: projector-singular, nullspace-any-size
// mistake: Where the arm is stretched out, J J^T has no inverse.

// <solution nullspaceProjector>
return Eigen::MatrixXd::Identity(J.cols(), J.cols()) - J.transpose() * inverse(J * J.transpose()) * J;
// </solution>
