// caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: looks at the configurations only: thin obstacles fit between two of them.

// <solution aroundObstacle>
constexpr int kSamples = 1;
const Eigen::VectorXd start = S.getJointAngles();
const Eigen::Index n = start.size();
const int last = errand.steps - 1;
const Terms terms = [&](const Eigen::MatrixXd& X) {
  Eigen::MatrixXd path(n, 2 + X.cols());
  path << start, start, X;
  std::vector<Term> all;
  const auto add = [&](Role role, int t, const TermValue& value) {
    all.push_back({role, t, value.y, value.J});
  };
  for (int t = 0; t <= last; ++t) {
    add(Role::cost, t, differenceTerm(path.middleCols(t, 3), errand.tau));
    add(Role::inequality, t, keptApart(S, path.middleCols(t + 1, 2), errand.margin, kSamples));
  }
  add(Role::equality, last, {X.col(last) - errand.goal, Eigen::MatrixXd::Identity(n, n)});
  add(Role::equality, last, differenceTerm(X.rightCols(2), 1));
  return all;
};
Eigen::MatrixXd points(n, 2);
points << errand.detour, errand.goal;
const Eigen::MatrixXd guess = throughPoints(start, points, {last / 2, last}, errand.tau);
const Eigen::MatrixXd X = minimised(terms, guess, 1000, {1e-4, 1e-3}).X;
S.setJointAngles(start);
return X;
// </solution>
