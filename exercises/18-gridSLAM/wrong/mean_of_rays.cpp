// caught by: fits
// mistake: the mean over the rays.

// <solution fit>
double sum = 0;
for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
  if (scan.ranges[ray] >= scan.maxRange) continue;
  const double direction = pose[2] + scan.angles[ray];
  const double d = valueAt(distances, {pose[0] + scan.ranges[ray] * std::cos(direction),
                                       pose[1] + scan.ranges[ray] * std::sin(direction)});
  sum += d * d;
}
return -sum / (2 * deviation * deviation * static_cast<double>(scan.ranges.size()));
// </solution>
