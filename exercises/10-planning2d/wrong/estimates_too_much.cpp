// caught by: astar-estimate
// mistake: the sum of both differences, as if there were no diagonals; A* may then find a detour.

// <solution emptyMapDistance>
return std::abs(to.x - from.x) + std::abs(to.y - from.y);
// </solution>
