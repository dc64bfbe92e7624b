// caught by: assembled
// mistake: the J of each term begins k configurations back, with the largest order k.

// <solution assembled>
const int rows = (orderOf(terms, n) + 1) * n;
BandSystem system{Eigen::MatrixXd::Zero(rows, n* steps), Eigen::VectorXd::Zero(n* steps)};
for (const Term& term : terms) {
  const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - rows;
  for (Eigen::Index a = std::max<Eigen::Index>(0, -first); a < columns; ++a) {
    system.g[first + a] += 2 * term.J.col(a).dot(term.y);
    for (Eigen::Index b = a; b < columns; ++b)
      system.band(b - a, first + a) += 2 * term.J.col(a).dot(term.J.col(b));
  }
}
return system;
// </solution>
