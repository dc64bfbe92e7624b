// caught by: tree-metrics
// mistake: the difference of two angles, the long way round if need be.

// <solution angleDistance>
return std::abs(a - b);
// </solution>

// <solution poseDistance>
return (a - b).norm();
// </solution>
