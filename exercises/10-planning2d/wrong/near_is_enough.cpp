// caught by: prm-samplers, prm-passage
// mistake: uniform positions near a block, and uniform ones with blocks above and below; no normal numbers.

// <solution gaussianSample>
const auto q = uniformSample(yard, rng);
if (!q) return std::nullopt;
for (const Block& block : yard.blocks)
  if ((nearestPoint(block, *q) - *q).norm() < 1.254 * sigma) return q;
return std::nullopt;
// </solution>
// <solution bridgeSample>
const auto q = uniformSample(yard, rng);
const Eigen::Vector2d up(0, sigma / 2);
if (q && !isFree(yard, *q + up) && !isFree(yard, *q - up)) return q;
return std::nullopt;
// </solution>
