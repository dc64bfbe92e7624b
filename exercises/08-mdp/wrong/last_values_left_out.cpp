// caught by: settles, unseen-settle
// shown by: settles
// mistake: ends before the values that fulfil the bound are listed.

// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (;;) {
  const Eigen::VectorXd next = worthOfActions(process, all.back()).rowwise().maxCoeff();
  const double change = (next - all.back()).cwiseAbs().maxCoeff();
  if (process.discount / (1 - process.discount) * change <= tolerance) return all;
  all.push_back(next);
}
// </solution>
