// caught by: worth, larger
// shown by: worth
// mistake: adds the value of the state instead of that of the next one.

// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
Q.colwise() += process.discount * V;
return Q;
// </solution>
