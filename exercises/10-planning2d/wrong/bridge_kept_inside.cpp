// caught by: prm-samplers
// mistake: pulls the other end back into the yard: there is no bridge to its outside.

// <solution bridgeSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const Eigen::Vector2d q2 = (q1 + sigma * rng.normalVector(2)).cwiseMax(0).cwiseMin(yard.size);
const Eigen::Vector2d q3 = (q1 + q2) / 2;
if (!isFree(yard, q1) && !isFree(yard, q2) && isFree(yard, q3)) return q3;
return std::nullopt;
// </solution>
