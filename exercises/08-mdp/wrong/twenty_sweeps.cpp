// caught by: policy-values, larger
// shown by: policy-values
// mistake: iterates eq. (9) twenty times instead of solving it.

// <solution valuesOf>
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
for (int sweep = 0; sweep < 20; ++sweep)
  V = worthOfActions(process, V).cwiseProduct(policy).rowwise().sum().eval();
return V;
// </solution>
