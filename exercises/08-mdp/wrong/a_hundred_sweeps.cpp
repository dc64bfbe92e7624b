// caught by: settles, unseen-settle
// shown by: settles
// mistake: iterates a hundred times, whatever the tolerance.

// <solution iterateValues>
std::vector<Eigen::VectorXd> all{Eigen::VectorXd::Zero(process.R.rows())};
for (int k = 0; k < 100; ++k) all.push_back(worthOfActions(process, all.back()).rowwise().maxCoeff());
return all;
// </solution>
