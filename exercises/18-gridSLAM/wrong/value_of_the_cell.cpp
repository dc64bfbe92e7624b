// caught by: fits, more-fits
// mistake: the value of the cell, in steps.

// <solution valueAt>
const Eigen::Vector2i cell = cellAt(grid, p);
return grid.values(std::clamp<Eigen::Index>(cell[0], 0, grid.values.rows() - 1),
                   std::clamp<Eigen::Index>(cell[1], 0, grid.values.cols() - 1));
// </solution>
