// caught by: priority-first, priority-any
// mistake: A second task of low weight still disturbs the first a little.

// <solution priorityStep>
const Eigen::MatrixXd W = 1e-6 * Eigen::MatrixXd::Identity(J1.cols(), J1.cols());
return multiTaskStep({TaskTerm{-dy1, J1, 1e4}, TaskTerm{-dy2, J2, 1}}, W);
// </solution>
