// caught by: rays, more-rays
// shown by: rays
// mistake: a line as it is drawn on screens: from cell to cell, also diagonally.

// <solution cellsAlong>
Eigen::Vector2i cell = cellAt(grid, from);
const Eigen::Vector2i last = cellAt(grid, to);
std::vector<Eigen::Vector2i> cells{cell};
const int dx = std::abs(last[0] - cell[0]), dy = -std::abs(last[1] - cell[1]);
for (int error = dx + dy; cell != last;) {
  const int twice = 2 * error;
  if (twice >= dy) error += dy, cell[0] += last[0] > cell[0] ? 1 : -1;
  if (twice <= dx) error += dx, cell[1] += last[1] > cell[1] ? 1 : -1;
  cells.push_back(cell);
}
return cells;
// </solution>
