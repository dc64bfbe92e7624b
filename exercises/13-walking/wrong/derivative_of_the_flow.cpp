// caught by: derivative, gait, other-gaits
// mistake: keeps the time of the step fixed, so that the foot need not be on the ground when it lands.

// <solution stepDerivative>
constexpr double d = 1e-5;
const auto end = stepFrom(walker, x);
if (!end) return Eigen::Matrix4d::Constant(NAN);
const auto flow = [&](Eigen::Vector4d at) {
  for (int i = 0; i < 1000; ++i) at = swung(walker, at, end->time / 1000);
  return impactOf(walker, at);
};
Eigen::Matrix4d J;
for (int i = 0; i < 4; ++i) {
  const Eigen::Vector4d change = d * Eigen::Vector4d::Unit(i);
  J.col(i) = (flow(x + change) - flow(x - change)) / (2 * d);
}
return J;
// </solution>
