// caught by: projector, nullspace-any-size
// mistake: A large precision is not an infinite one: a part of each motion still moves the task.

// <solution nullspaceProjector>
const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(J.cols(), J.cols());
return W - regularisedInverse(J, W, 1e9) * J;
// </solution>
