// caught by: settles, unseen-settle
// shown by: settles
// mistake: takes a small change for a small error.

// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (double change = INFINITY; change > tolerance;) {
  all.push_back(worthOfActions(process, all.back()).rowwise().maxCoeff());
  change = (all.back() - all[all.size() - 2]).cwiseAbs().maxCoeff();
}
return all;
// </solution>
