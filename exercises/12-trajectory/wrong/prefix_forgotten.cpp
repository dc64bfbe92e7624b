// caught by: cost-of-powers, any-path
// mistake: the first cost is at the first step that has k others before it in X.

// <solution motionCost>
double cost = 0;
for (Eigen::Index t = k; t < X.cols(); ++t)
  cost += differenceTerm(X.middleCols(t - k, k + 1), tau).y.squaredNorm();
return cost;
// </solution>
