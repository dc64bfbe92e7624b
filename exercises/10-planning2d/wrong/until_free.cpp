// caught by: prm-samplers
// mistake: tries until a point is free: that is more than one attempt.

// <solution uniformSample>
for (;;) {
  const Eigen::Vector2d q(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
  if (isFree(yard, q)) return q;
}
// </solution>
