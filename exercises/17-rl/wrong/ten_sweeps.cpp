// caught by: plan, more-plans
// shown by: plan
// mistake: ends after ten sweeps.

// <solution plannedValues>
Eigen::MatrixXd Q = Eigen::MatrixXd::Zero(model.R.rows(), model.R.cols());
for (int i = 0; i < 10; ++i) {
  const Eigen::VectorXd V = Q.rowwise().maxCoeff();
  Eigen::MatrixXd next = model.R;
  for (Eigen::Index a = 0; a < Q.cols(); ++a)
    next.col(a) += discount * model.P[static_cast<std::size_t>(a)] * V;
  Q = next;
}
return Q;
// </solution>
