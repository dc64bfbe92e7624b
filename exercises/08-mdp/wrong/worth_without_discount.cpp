// caught by: worth, larger
// mistake: discount forgotten.

// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
for (Eigen::Index a = 0; a < Q.cols(); ++a) Q.col(a) += process.P[static_cast<std::size_t>(a)] * V;
return Q;
// </solution>
