// caught by: field-potential
// mistake: blocks beyond their reach push, too: the square hides the sign.

// <solution fieldPotential>
U = gains.attraction * (p - goal).squaredNorm() / 2;
for (const Block& block : yard.blocks) {
  const double excess = 1 / (p - nearestPoint(block, p)).norm() - 1 / gains.reach;
  U += gains.repulsion * excess * excess / 2;
}
// </solution>
// <solution fieldGradient>
gradient = gains.attraction * (p - goal);
for (const Block& block : yard.blocks) {
  const Eigen::Vector2d away = p - nearestPoint(block, p);
  const double distance = away.norm(), excess = 1 / distance - 1 / gains.reach;
  gradient -= gains.repulsion * excess / (distance * distance * distance) * away;
}
// </solution>
