// caught by: prm-samplers
// mistake: a generator of its own, which goes on from call to call.

// <solution uniformSample>
static Rng mine(1);
const Eigen::Vector2d q(mine.uniform(0, yard.size.x()), mine.uniform(0, yard.size.y()));
if (isFree(yard, q)) return q;
return std::nullopt;
// </solution>
