// caught by: box
// mistake: corrects the guess of what is held everywhere at once, and gives up in the end.

// <solution boxed>
const int size = static_cast<int>(lower.size());
Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
std::vector<int> held(static_cast<std::size_t>(size), 0);  // -1 at the lower bound, 1 at the upper one
for (int round = 0; round < 200; ++round) {
  Eigen::MatrixXd rows = cost.H;
  Eigen::VectorXd right = -cost.g;
  for (int i = 0; i < size; ++i) {
    const int side = held[static_cast<std::size_t>(i)];
    if (side == 0) continue;
    rows.row(i) = Eigen::RowVectorXd::Unit(size, i);
    right[i] = side < 0 ? lower[i] : upper[i];
  }
  z = solve(rows, right);
  const Eigen::VectorXd slope = cost.H * z + cost.g;
  bool isSame = true;
  for (int i = 0; i < size; ++i) {
    int& side = held[static_cast<std::size_t>(i)];
    const int before = side;
    if (side == 0)
      side = z[i] < lower[i] ? -1 : z[i] > upper[i] ? 1 : 0;
    else if (side * slope[i] > 0)
      side = 0;
    isSame = isSame && side == before;
  }
  if (isSame) break;
}
return z.cwiseMax(lower).cwiseMin(upper);
// </solution>
