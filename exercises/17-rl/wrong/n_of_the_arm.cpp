// caught by: bounds, other-bounds
// shown by: bounds
// mistake: counts only the pulls of the arm itself.

// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (2 * N.log() / N).sqrt();
// </solution>
