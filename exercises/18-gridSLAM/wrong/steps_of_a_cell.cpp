// caught by: rays, more-rays
// mistake: looks once per side of a cell.

// <solution cellsAlong>
std::vector<Eigen::Vector2i> cells{cellAt(grid, from)};
const int count = static_cast<int>(std::ceil((to - from).norm() / grid.cell));
for (int k = 1; k <= count; ++k) {
  const Eigen::Vector2i cell = cellAt(grid, from + (to - from) * k / count);
  if (cell != cells.back()) cells.push_back(cell);
}
return cells;
// </solution>
