// caught by: cones, any-cones, all-wrenches
// mistake: takes the friction for the half angle of the cone.

// <solution inCone>
if (force.norm() == 0) return true;
return std::acos(std::min(1., force.dot(finger.normal) / force.norm())) <= finger.friction + 1e-7;
// </solution>

// <solution pyramidEdges>
const Eigen::Vector3d& n = finger.normal;
const Eigen::Vector3d least = std::abs(n.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
const Eigen::Vector3d a = n.cross(least).normalized(), b = n.cross(a);
for (int k = 0; k < edges; ++k) {
  const double angle = 2 * std::numbers::pi * k / edges;
  forces.col(k) = n + std::tan(finger.friction) * (std::cos(angle) * a + std::sin(angle) * b);
}
// </solution>
