// caught by: assembled, unseen-descents
// mistake: the blocks of H between two configurations are transposed.

// <solution assembled>
const int rows = (orderOf(terms, n) + 1) * n;
BandSystem system{Eigen::MatrixXd::Zero(rows, n* steps), Eigen::VectorXd::Zero(n* steps)};
for (const Term& term : terms) {
  const int k = static_cast<int>(term.J.cols()) / n - 1;
  for (int p = 0; p <= k; ++p) {
    const int column = n * (term.t - k + p);
    if (column < 0) continue;
    const Eigen::MatrixXd Jp = term.J.middleCols(n * p, n);
    system.g.segment(column, n) += 2 * Jp.transpose() * term.y;
    for (int q = p; q <= k; ++q) {
      const Eigen::MatrixXd block = 2 * Jp.transpose() * term.J.middleCols(n * q, n);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          if (q > p || a >= b) system.band(n * (q - p) + a - b, column + b) += block(a, b);
    }
  }
}
return system;
// </solution>
