// caught by: moment, moment-any
// mistake: the ground is always at zero.

// <solution zeroMoment>
Eigen::Vector2d sum = Eigen::Vector2d::Zero();
double push = 0;
for (const MovingMass& part : robot) {
  const Eigen::Vector3d force = part.mass * (part.a + Eigen::Vector3d(0, 0, g));
  push += force.z();
  sum += force.z() * part.p.head<2>() - part.p.z() * force.head<2>();
}
if (push <= 0) return std::nullopt;
return Eigen::Vector2d(sum / push);
// </solution>
