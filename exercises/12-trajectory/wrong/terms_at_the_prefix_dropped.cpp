// caught by: assembled, unseen-descents, through-points
// mistake: leaves out the terms that reach into the prefix.

// <solution assembled>
const int rows = (orderOf(terms, n) + 1) * n;
BandSystem system{Eigen::MatrixXd::Zero(rows, n* steps), Eigen::VectorXd::Zero(n* steps)};
for (const Term& term : terms) {
  const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - columns;
  if (first < 0) continue;
  for (Eigen::Index a = 0; a < columns; ++a) {
    system.g[first + a] += 2 * term.J.col(a).dot(term.y);
    for (Eigen::Index b = a; b < columns; ++b)
      system.band(b - a, first + a) += 2 * term.J.col(a).dot(term.J.col(b));
  }
}
return system;
// </solution>
