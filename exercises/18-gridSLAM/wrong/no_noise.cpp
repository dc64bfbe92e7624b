// caught by: motion
// mistake: odometry is right.

// <solution moved>
const double cosine = std::cos(pose[2]), sine = std::sin(pose[2]);
for (int k = 0; k < count; ++k) {
  Eigen::Vector3d way = motion;
  for (int i = 0; i < 3; ++i) way[i] += 0 * deviations[i] * rng.normal();
  poses.col(k) += Eigen::Vector3d(cosine * way[0] - sine * way[1], sine * way[0] + cosine * way[1], way[2]);
}
// </solution>
