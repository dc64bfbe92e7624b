// caught by: prm-samplers, prm-passage
// mistake: both ends are blocked, so the middle is taken for a passage; it is hardly ever one.

// <solution bridgeSample>
const double x = rng.uniform(0, yard.size.x()), y = rng.uniform(0, yard.size.y());
const Eigen::Vector2d q1(x, y), q2 = q1 + sigma * rng.normalVector(2);
if (isFree(yard, q1) || isFree(yard, q2)) return std::nullopt;
return Eigen::Vector2d((q1 + q2) / 2);
// </solution>
