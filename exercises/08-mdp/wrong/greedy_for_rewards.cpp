// caught by: improves, unseen-improve
// mistake: takes the best reward now, as if nothing followed.

// <solution iteratePolicies>
std::vector<std::vector<int>> policies(2, std::vector<int>(static_cast<std::size_t>(process.R.rows()), 0));
for (std::size_t s = 0; s < policies[1].size(); ++s)
  process.R.row(static_cast<Eigen::Index>(s)).maxCoeff(&policies[1][s]);
return policies;
// </solution>
