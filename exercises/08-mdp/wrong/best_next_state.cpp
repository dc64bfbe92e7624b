// caught by: worth, larger
// shown by: worth
// mistake: takes the best next state for granted.

// <solution worthOfActions>
Eigen::MatrixXd Q = process.R;
for (Eigen::Index s = 0; s < Q.rows(); ++s)
  for (Eigen::Index a = 0; a < Q.cols(); ++a) {
    double best = -INFINITY;
    for (Eigen::Index t = 0; t < V.size(); ++t)
      if (process.P[static_cast<std::size_t>(a)](s, t) > 0) best = std::max(best, V[t]);
    if (std::isfinite(best)) Q(s, a) += process.discount * best;
  }
return Q;
// </solution>
