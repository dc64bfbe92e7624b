// caught by: motion
// mistake: noise is added after the rotation.

// <solution moved>
const double c = std::cos(pose[2]), s = std::sin(pose[2]);
for (int k = 0; k < count; ++k) {
  poses.col(k) += Eigen::Vector3d(c * motion[0] - s * motion[1], s * motion[0] + c * motion[1], motion[2]);
  for (int i = 0; i < 3; ++i) poses(i, k) += deviations[i] * rng.normal();
}
// </solution>
