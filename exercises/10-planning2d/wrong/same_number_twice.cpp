// caught by: prm-samplers
// mistake: adds the same normal number to both coordinates.

// <solution gaussianSample>
const Eigen::Vector2d q1(rng.uniform(0, yard.size.x()), rng.uniform(0, yard.size.y()));
const double z = rng.normal();
const Eigen::Vector2d q2 = q1 + sigma * Eigen::Vector2d(z, z);
if (isFree(yard, q1) && !isFree(yard, q2)) return q1;
if (!isFree(yard, q1) && isFree(yard, q2)) return q2;
return std::nullopt;
// </solution>
