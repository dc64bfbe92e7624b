// caught by: rays
// mistake: the last cell is left out.

// <solution cellsAlong>
Eigen::Vector2i cell = cellAt(grid, from);
const Eigen::Vector2i last = cellAt(grid, to);
const Eigen::Vector2d way = to - from;
// Where on the way the next border along x and the next one along y are, and from one to the next.
Eigen::Vector2d next, gap;
for (const int k : {0, 1}) {
  const double border = grid.origin[k] + grid.cell * (cell[k] + (way[k] > 0 ? 1 : 0));
  next[k] = way[k] == 0 ? 2 : (border - from[k]) / way[k];
  gap[k] = way[k] == 0 ? 2 : grid.cell / std::abs(way[k]);
}
std::vector<Eigen::Vector2i> cells{cell};
for (int left = (last - cell).cwiseAbs().sum(); left > 0; --left) {
  const int axis = next[0] < next[1] ? 0 : 1;
  cell[axis] += way[axis] > 0 ? 1 : -1;
  next[axis] += gap[axis];
  cells.push_back(cell);
}
if (cells.size() > 1) cells.pop_back();
return cells;
// </solution>
