// caught by: returns
// shown by: returns
// mistake: counts the discount from the start of the trial.

// <solution returnsToGo>
Eigen::VectorXd returns = rewards;
for (Eigen::Index t = 0; t < rewards.size(); ++t) returns[t] *= std::pow(discount, t);
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t) returns[t] += returns[t + 1];
return returns;
// </solution>
