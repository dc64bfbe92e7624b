// caught by: inverse, nullspace-any-size
// mistake: All joints cost the same, whatever W says.

// <solution regularisedInverse>
const Eigen::MatrixXd same = Eigen::MatrixXd::Identity(W.rows(), W.cols());
return solve(precision * J.transpose() * J + same, precision* J.transpose());
// </solution>
