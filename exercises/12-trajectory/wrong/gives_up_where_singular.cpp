// caught by: descends
// mistake: ends where H is singular.

// <solution descended>
const int n = static_cast<int>(start.rows()), T = static_cast<int>(start.cols());
const auto costOf = [](const std::vector<Term>& all) {
  double cost = 0;
  for (const Term& term : all) cost += term.y.squaredNorm();
  return cost;
};
std::vector<Eigen::MatrixXd> path{start};
std::vector<Term> here = terms(start);
while (path.size() <= 300) {
  BandSystem system = assembled(here, n, T);
  if (system.g.cwiseAbs().maxCoeff() <= tolerance) break;
  const Eigen::MatrixXd L = bandCholesky(system.band);
  if (L.size() == 0) break;
  const Eigen::VectorXd down = bandSolve(L, system.g);
  const Eigen::MatrixXd step = down.reshaped(n, T);
  const double cost = costOf(here), slope = system.g.dot(down);
  double share = 1;
  Eigen::MatrixXd next;
  for (;; share /= 2) {
    next = path.back() - share * step;
    here = terms(next);
    if (share < 1e-10 || costOf(here) <= cost - 0.01 * share * slope) break;
  }
  if (!(costOf(here) < cost)) break;
  path.push_back(next);
}
return path;
// </solution>
