// caught by: quarter-turn
// shown by: quarter-turn
// mistake: turns clockwise.

// <solution rotated>
const double c = std::cos(angle);
const double s = std::sin(angle);
return {c * p.x() + s * p.y(), c* p.y() - s* p.x()};
// </solution>
