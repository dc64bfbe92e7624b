// caught by: fits, more-fits
// mistake: rays that hit nothing should end at walls as well.

// <solution fit>
double sum = 0;
for (Eigen::Index ray = 0; ray < scan.angles.size(); ++ray) {
  const double direction = pose[2] + scan.angles[ray];
  const double d = valueAt(distances, {pose[0] + scan.ranges[ray] * std::cos(direction),
                                       pose[1] + scan.ranges[ray] * std::sin(direction)});
  sum += d * d;
}
return -sum / (2 * deviation * deviation);
// </solution>
