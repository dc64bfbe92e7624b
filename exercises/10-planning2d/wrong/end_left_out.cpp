// caught by: prm-straight
// mistake: tests from the beginning on, but not the end.

// <solution straightIsFree>
const double length = (b - a).norm();
for (double s = 0; s < length; s += resolution)
  if (!isFree(yard, a + s / length * (b - a))) return false;
return true;
// </solution>
