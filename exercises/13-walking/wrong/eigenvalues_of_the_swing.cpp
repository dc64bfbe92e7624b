// caught by: gait, other-gaits
// mistake: eigenvalues of the rate at the beginning of a step, as if nothing else happened in it.

// <solution multiplierSizes>
Eigen::Matrix4d J;
for (int i = 0; i < 4; ++i) {
  const Eigen::Vector4d change = 1e-5 * Eigen::Vector4d::Unit(i);
  J.col(i) = (swingRate(walker, gait + change) - swingRate(walker, gait - change)) / 2e-5;
}
Eigen::VectorXd sizes = eigenvalues(J).cwiseAbs();
std::sort(sizes.begin(), sizes.end(), std::greater<>());
return sizes;
// </solution>
