// caught by: astar-estimate
// mistake: the sum of both differences, as if there were no diagonals; the way that A* finds with it may be a detour.

// <solution emptyMapDistance>
return std::abs(to.x - from.x) + std::abs(to.y - from.y);
// </solution>
