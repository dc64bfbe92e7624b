// caught by: prm-samplers, prm-passage
// mistake: only the first point can become a node, not the second.

// <solution gaussianSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const Eigen::Vector2d q2 = q1 + sigma * rng.normalVector(2);
if (isFree(yard, q1) && !isFree(yard, q2)) return q1;
return std::nullopt;
// </solution>
