// caught by: rays
// mistake: the grid begins at (0, 0).

// <solution cellAt>
return {static_cast<int>(std::floor(p.x() / grid.cell)), static_cast<int>(std::floor(p.y() / grid.cell))};
// </solution>
