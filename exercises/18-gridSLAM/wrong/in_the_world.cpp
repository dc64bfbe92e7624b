// caught by: motion
// mistake: the motion is not rotated.

// <solution moved>
const double cosine = std::cos(pose[2]), sine = std::sin(pose[2]);
for (int k = 0; k < count; ++k) {
  Eigen::Vector3d way = motion;
  for (int i = 0; i < 3; ++i) way[i] += deviations[i] * rng.normal();
  poses.col(k) += way;
}
// </solution>
