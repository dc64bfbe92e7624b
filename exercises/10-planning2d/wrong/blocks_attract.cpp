// caught by: field-gradient, field-slide, field-any-yard
// shown by: field-slide
// mistake: the repulsion has the wrong sign.

// <solution fieldGradient>
gradient = gains.attraction * (p - goal);
for (const Block& block : yard.blocks) {
  const Eigen::Vector2d away = p - nearestPoint(block, p);
  const double distance = away.norm();
  if (distance >= gains.reach) continue;
  const double excess = 1 / distance - 1 / gains.reach;
  gradient += gains.repulsion * excess / (distance * distance * distance) * away;
}
// </solution>
// <solution slideDown>
while ((trail.points.back() - goal).norm() > stepSize && trail.points.size() < 1000) {
  const Eigen::Vector2d p = trail.points.back(), gradient = fieldGradient(yard, goal, gains, p);
  if (gradient.norm() < 0.01 * gains.attraction) return trail;
  trail.points.push_back(p - std::min(stepSize / gradient.norm(), 0.1) * gradient);
}
trail.ending = Ending::kAtGoal;
// </solution>
