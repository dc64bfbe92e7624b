// caught by: descends, unseen-descents
// shown by: descends
// mistake: takes every step in full, whether the cost falls or not.

// <solution descended>
const auto n = static_cast<int>(start.rows()), steps = static_cast<int>(start.cols());
std::vector<Eigen::MatrixXd> path{start};
while (path.size() <= 100) {
  BandSystem system = assembled(terms(path.back()), n, steps);
  if (!(system.g.cwiseAbs().maxCoeff() > tolerance)) break;
  Eigen::MatrixXd L = bandCholesky(system.band);
  if (L.size() == 0) {
    system.band.row(0).array() += 1e-6;
    L = bandCholesky(system.band);
  }
  if (L.size() == 0) break;
  const Eigen::VectorXd step = -bandSolve(L, system.g);
  path.push_back(path.back() + step.reshaped(n, steps));
}
return path;
// </solution>
