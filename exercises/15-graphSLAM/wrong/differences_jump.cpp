// caught by: error-derivatives, error-turns
// mistake: takes differences of errors without wrapping that of the headings.

// <solution edgeJacobians>
const double h = 1e-6;
for (int k = 0; k < 3; ++k) {
  const Eigen::Vector3d d = h * Eigen::Vector3d::Unit(k);
  jacobians.byI.col(k) = (edgeError(i + d, j, z) - edgeError(i - d, j, z)) / (2 * h);
  jacobians.byJ.col(k) = (edgeError(i, j + d, z) - edgeError(i, j - d, z)) / (2 * h);
}
// </solution>
