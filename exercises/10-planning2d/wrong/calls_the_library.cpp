// caught by: forbidden-call
// mistake: lets the library number the cells.

// <solution headers>
#include "planning/grid_search.h"
// </solution>

// <solution waveNumbers>
GridMap grid(map.width, map.height);
for (std::size_t place = 0; place < numbers.size(); ++place)
  grid.setBlocked({map.cellAt(place).x, map.cellAt(place).y}, numbers[place] != 0);
numbers = wavefront(grid, {goal.x, goal.y}, Connectivity::kEight);
// </solution>
