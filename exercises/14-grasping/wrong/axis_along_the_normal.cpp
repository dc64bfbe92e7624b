// caught by: any-cones
// mistake: the first direction along the surface comes from the z axis, which may be the normal.

// <solution pyramidEdges>
const Eigen::Vector3d& n = finger.normal;
const Eigen::Vector3d a = n.cross(Eigen::Vector3d::UnitZ()).normalized(), b = n.cross(a);
for (int k = 0; k < edges; ++k) {
  const double angle = 2 * std::numbers::pi * k / edges;
  forces.col(k) = n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b);
}
// </solution>
