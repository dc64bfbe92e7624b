// caught by: reach-radius, reach-any-arm
// mistake: counts one of the two angles that lead to the same radius.

// <solution radiusDensity>
const double cosine = (r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2);
if (std::abs(cosine) >= 1) return 0;
return r / (2 * std::numbers::pi * l1 * l2 * std::sqrt(1 - cosine * cosine));
// </solution>
