// caught by: returns
// mistake: discount forgotten.

// <solution returnsToGo>
Eigen::VectorXd returns = rewards;
for (Eigen::Index t = rewards.size() - 2; t >= 0; --t) returns[t] += returns[t + 1];
return returns;
// </solution>
