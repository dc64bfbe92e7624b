// caught by: through-points, other-points
// mistake: the motion ends at the last point, but not at rest.

// <solution throughPoints>
const Eigen::Index n = start.size();
const Terms terms = [&](const Eigen::MatrixXd& X) {
  Eigen::MatrixXd path(n, 2 + X.cols());
  path << start, start, X;
  std::vector<Term> all;
  const auto add = [&](Role role, int t, const TermValue& value) {
    all.push_back({role, t, value.y, value.J});
  };
  for (int t = 0; t < X.cols(); ++t) add(Role::cost, t, differenceTerm(path.middleCols(t, 3), tau));
  for (std::size_t i = 0; i < when.size(); ++i)
    add(Role::equality, when[i],
        {X.col(when[i]) - points.col(static_cast<Eigen::Index>(i)), Eigen::MatrixXd::Identity(n, n)});
  return all;
};
return minimised(terms, start.replicate(1, when.back() + 1), 10 / std::pow(tau, 3), {1e-9, 1e-6}).X;
// </solution>
