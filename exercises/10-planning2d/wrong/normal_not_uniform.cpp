// caught by: prm-samplers
// mistake: normal numbers around the middle of the yard, limited to it.

// <solution uniformSample>
Eigen::Vector2d q = yard.size / 2 + yard.size.cwiseProduct(rng.normalVector(2)) / std::sqrt(12.);
q = q.cwiseMax(0).cwiseMin(yard.size);
if (isFree(yard, q)) return q;
return std::nullopt;
// </solution>
