// caught by: maze, other-mazes
// shown by: maze
// mistake: discounts the rewards of the leaves, too.

// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random.tail(4) = values.optimal.tail(4) = discount * leaves;
for (int s = 2; s >= 0; --s) {
  const int left = 2 * s + 1, right = 2 * s + 2;
  values.random[s] = discount * (values.random[left] + values.random[right]) / 2;
  values.optimal[s] = discount * std::max(values.optimal[left], values.optimal[right]);
}
return values;
// </solution>
