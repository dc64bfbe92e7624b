// caught by: field-gradient
// mistake: the distance to a block counts as 0.1 m at least, lest the push explode.

// <solution fieldGradient>
gradient = gains.attraction * (p - goal);
for (const Block& block : yard.blocks) {
  const Eigen::Vector2d away = p - nearestPoint(block, p);
  const double d = std::max(.1, away.norm());
  if (d < gains.reach) gradient -= gains.repulsion * (1 / d - 1 / gains.reach) / (d * d) * away / d;
}
// </solution>
