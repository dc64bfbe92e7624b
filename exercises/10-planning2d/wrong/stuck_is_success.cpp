// caught by: field-slide, field-any-yard
// mistake: takes every point where the gradient vanishes for the goal.

// <solution slideDown>
while (fieldGradient(yard, goal, gains, trail.points.back()).norm() >= 0.01 * gains.attraction) {
  const Eigen::Vector2d p = trail.points.back(), gradient = fieldGradient(yard, goal, gains, p);
  const double slope = gradient.norm(), U = fieldPotential(yard, goal, gains, p);
  double step = std::min(stepSize, slope / gains.attraction);
  const auto next = [&] { return Eigen::Vector2d(p - step / slope * gradient); };
  while (!(fieldPotential(yard, goal, gains, next()) < U - 0.1 * slope * step)) step /= 2;
  trail.points.push_back(next());
}
trail.ending = Ending::kAtGoal;
// </solution>
