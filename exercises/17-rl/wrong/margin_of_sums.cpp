// caught by: bounds, other-bounds
// mistake: adds the margin to the sum of payments.

// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() + (2 * std::log(N.sum()) / N).sqrt();
// </solution>
