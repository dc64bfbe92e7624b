// caught by: more-boxes
// mistake: moves each number in turn, but only a hundred times.

// <solution boxed>
Eigen::VectorXd z = Eigen::VectorXd::Zero(lower.size()).cwiseMax(lower).cwiseMin(upper);
for (int round = 0; round < 100; ++round)
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = std::clamp(z[i] - (cost.H.row(i).dot(z) + cost.g[i]) / cost.H(i, i), lower[i], upper[i]);
return z;
// </solution>
