// caught by: scan-motion
// shown by: scan-motion
// mistake: shifts the points, but does not rotate them.

// <solution partners>
for (std::size_t k = 0; k < moving.size(); ++k) {
  const double x = motion[0] + moving[k].x();
  const double y = motion[1] + moving[k].y();
  double nearest = maxDistance * maxDistance;
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const double dx = reference[i].x() - x, dy = reference[i].y() - y, squared = dx * dx + dy * dy;
    if (squared > nearest) continue;
    nearest = squared;
    numbers[k] = static_cast<int>(i);
  }
}
// </solution>
