// caught by: settles, unseen-settle
// shown by: settles
// mistake: lists the values from V_1 on.

// <solution iterateValues>
std::vector<Eigen::VectorXd> all;
Eigen::VectorXd V = Eigen::VectorXd::Zero(process.R.rows());
double bound = INFINITY;
while (bound > tolerance) {
  const Eigen::VectorXd next = worthOfActions(process, V).rowwise().maxCoeff();
  bound = process.discount / (1 - process.discount) * (next - V).cwiseAbs().maxCoeff();
  all.push_back(next);
  V = next;
}
return all;
// </solution>
