// caught by: bug-known-maps
// mistake: takes passing the cell where it met the obstacle for a full circuit.

// <solution bugTwo>
const auto leftmost = [&](MapCell cell, int heading) {
  for (int turn = 0; turn < 4; ++turn, --heading)
    if (isFree(ahead(cell, heading))) return heading;
  return heading;
};
for (std::size_t at = 0; at + 1 < mLine.size();) {
  if (isFree(mLine[at + 1])) {
    trail.cells.push_back(mLine[++at]);
    continue;
  }
  MapCell cell = mLine[at];
  int heading = 0;
  while (ahead(cell, heading) != mLine[at + 1]) ++heading;
  heading = leftmost(cell, heading - 1);
  if (!isFree(ahead(cell, heading))) return trail;
  const std::size_t hit = at;
  do {
    cell = ahead(cell, heading);
    trail.cells.push_back(cell);
    heading = leftmost(cell, heading + 1);
    const auto onLine = std::find(mLine.begin() + static_cast<std::ptrdiff_t>(hit), mLine.end(), cell);
    if (onLine != mLine.end()) at = static_cast<std::size_t>(onLine - mLine.begin());
    if (cell == mLine[hit]) return trail;
  } while (at == hit);
}
trail.reached = true;
// </solution>
