// caught by: fits
// mistake: distances are not squared.

// <solution fit>
double sum = 0;
for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
  if (scan.ranges[ray] >= scan.maxRange) continue;
  const double direction = pose[2] + scan.angles[ray];
  const double d = valueAt(distances, {pose[0] + scan.ranges[ray] * std::cos(direction),
                                       pose[1] + scan.ranges[ray] * std::sin(direction)});
  sum += d;
}
return -sum / (2 * deviation * deviation);
// </solution>
