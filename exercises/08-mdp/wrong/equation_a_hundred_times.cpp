// caught by: policy-values
// mistake: repeats eq. (9) a hundred times instead of solving it: too few if the discount is large.

// <solution valuesOf>
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
for (int k = 0; k < 100; ++k) V = worthOfActions(process, V).cwiseProduct(policy).rowwise().sum().eval();
return V;
// </solution>
