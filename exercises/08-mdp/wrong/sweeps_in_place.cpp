// caught by: settles, unseen-settle
// shown by: settles
// mistake: uses values of the same iteration as soon as they are there.

// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
double bound = INFINITY;
while (bound > tolerance) {
  Eigen::VectorXd next = all.back();
  for (Eigen::Index s = 0; s < next.size(); ++s) next[s] = worthOfActions(process, next).row(s).maxCoeff();
  bound = process.discount / (1 - process.discount) * (next - all.back()).cwiseAbs().maxCoeff();
  all.push_back(next);
}
return all;
// </solution>
