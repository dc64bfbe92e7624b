// caught by: filter-step, tracks, consistent, finds-heading
// mistake: no particles: their mean moves a fixed part of the way to where the car seems to be

// <solution filterStep>
const Eigen::Vector3d middle = before.states.rowwise().mean();
Eigen::Vector3d x = carStep(middle, u, world);
const double c = std::cos(x[2]), s = std::sin(x[2]);
Eigen::Vector2d shift = Eigen::Vector2d::Zero();
double turn = 0, all = 0;
for (Eigen::Index k = 0; k < world.landmarks.cols(); ++k) {
  Eigen::Vector2d seen = y.segment<2>(2 * k);
  if (world.rangeBearing) seen = seen[0] * Eigen::Vector2d(std::cos(seen[1]), std::sin(seen[1]));
  const Eigen::Vector2d arrow(c * seen[0] - s * seen[1], s * seen[0] + c * seen[1]);
  const Eigen::Vector2d off = world.landmarks.col(k) - x.head<2>() - arrow;
  shift += off / static_cast<double>(world.landmarks.cols());
  turn += arrow.x() * off.y() - arrow.y() * off.x();
  all += arrow.squaredNorm();
}
x += Eigen::Vector3d(0.25 * shift.x(), 0.25 * shift.y(), 0.15 * turn / all);
after.states.colwise() = x;
after.weights.setConstant(1. / static_cast<double>(after.weights.size()));
// </solution>
