// caught by: assembled, unseen-descents
// mistake: combines the gradient of y^T y / 2 with the second derivatives of y^T y: steps are half as long.

// <solution assembled>
const int rows = (orderOf(terms, n) + 1) * n;
BandSystem system{Eigen::MatrixXd::Zero(rows, n* steps), Eigen::VectorXd::Zero(n* steps)};
for (const Term& term : terms) {
  const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - columns;
  for (Eigen::Index a = std::max<Eigen::Index>(0, -first); a < columns; ++a) {
    system.g[first + a] += term.J.col(a).dot(term.y);
    for (Eigen::Index b = a; b < columns; ++b)
      system.band(b - a, first + a) += 2 * term.J.col(a).dot(term.J.col(b));
  }
}
return system;
// </solution>
