// caught by: maze
// shown by: maze
// mistake: discount forgotten.

// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random.tail(4) = values.optimal.tail(4) = leaves;
for (int s = 2; s >= 0; --s) {
  const int left = 2 * s + 1, right = 2 * s + 2;
  values.random[s] = (values.random[left] + values.random[right]) / 2;
  values.optimal[s] = std::max(values.optimal[left], values.optimal[right]);
}
return values;
// </solution>
