// caught by: through-points, other-points
// mistake: goes straight from point to point.

// <solution throughPoints>
Eigen::MatrixXd X(start.size(), when.back() + 1);
Eigen::VectorXd from = start;
int before = -1;
for (std::size_t i = 0; i < when.size(); ++i) {
  const Eigen::VectorXd to = points.col(static_cast<Eigen::Index>(i));
  for (int t = before + 1; t <= when[i]; ++t)
    X.col(t) = from + (t - before) / static_cast<double>(when[i] - before) * (to - from);
  from = to;
  before = when[i];
}
return X;
// </solution>
