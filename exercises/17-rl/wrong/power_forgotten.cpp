// caught by: bounds, other-bounds
// mistake: solves exp(-2 N b^2) = 1 / n.

// <solution upperBounds>
const Eigen::ArrayXd N = pulls.cast<double>();
return paid.array() / N + (std::log(N.sum()) / (2 * N)).sqrt();
// </solution>
