// caught by: maze, other-mazes
// shown by: maze
// mistake: takes the mean of both actions for the optimal policy, too.

// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random.tail(4) = leaves;
for (int s = 2; s >= 0; --s)
  values.random[s] = discount * (values.random[2 * s + 1] + values.random[2 * s + 2]) / 2;
values.optimal = values.random;
return values;
// </solution>
