// caught by: bounds, other-bounds
// shown by: bounds
// mistake: subtracts the margin.

// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N - (2 * std::log(N.sum()) / N).sqrt();
// </solution>
