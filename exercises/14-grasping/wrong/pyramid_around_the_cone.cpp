// caught by: cones, any-cones, all-wrenches
// shown by: cones
// mistake: a pyramid whose sides touch the cone, so that its edges lie outside.

// <solution pyramidEdges>
const Eigen::Vector3d& n = finger.normal;
const Eigen::Vector3d least = std::abs(n.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
const Eigen::Vector3d a = n.cross(least).normalized(), b = n.cross(a);
const double radius = finger.friction / std::cos(std::numbers::pi / edges);
for (int k = 0; k < edges; ++k) {
  const double angle = 2 * std::numbers::pi * k / edges;
  forces.col(k) = n + radius * (std::cos(angle) * a + std::sin(angle) * b);
}
// </solution>
