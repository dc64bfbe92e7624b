// caught by: other-mazes
// mistake: the numbers of the sheet typed in.

// <solution mazeValues>
MazeValues values{Eigen::VectorXd(7), Eigen::VectorXd(7)};
values.random << .5625, 1, 1.25, 4, 0, 2, 3;
values.optimal << 1, 2, 1.5, 4, 0, 2, 3;
return values;
// </solution>
