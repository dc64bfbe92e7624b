// caught by: tree-metrics
// mistake: takes the plain difference of two angles, even the long way round.

// <solution angleDistance>
return std::abs(a - b);
// </solution>

// <solution poseDistance>
return (a - b).norm();
// </solution>
