// caught by: kept-apart
// mistake: the derivatives by both ends of the way are swapped.

// <solution keptApart>
const Eigen::Index n = window.rows();
TermValue all;
for (int i = 0; i < samples; ++i) {
  const double s = (i + 1.) / samples;
  S.setJointAngles((1 - s) * window.col(0) + s * window.col(1));
  const Clearances d = clearances(S);
  const Eigen::Index pairs = d.y.size();
  if (i == 0) all = {Eigen::VectorXd(samples * pairs), Eigen::MatrixXd(samples * pairs, 2 * n)};
  all.y.segment(i * pairs, pairs) = (1 - d.y.array() / margin).matrix();
  all.J.block(i * pairs, 0, pairs, n) = -s / margin * d.J;
  all.J.block(i * pairs, n, pairs, n) = -(1 - s) / margin * d.J;
}
return all;
// </solution>
