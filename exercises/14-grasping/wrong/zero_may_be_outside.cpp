// caught by: radius, any-radius
// mistake: the distance of the nearest face, even if zero is outside of the hull.

// <solution epsilonOf>
const Eigen::Index n = wrenches.cols();
double least = INFINITY;
for (Eigen::Index i = 0; i < n; ++i)
  for (Eigen::Index j = i + 1; j < n; ++j)
    for (Eigen::Index k = j + 1; k < n; ++k) {
      const Eigen::Vector3d a = wrenches.col(i), b = wrenches.col(j), c = wrenches.col(k);
      const Eigen::Vector3d across = (b - a).cross(c - a);
      if (across.norm() < 1e-12) continue;
      const Eigen::VectorXd heights = wrenches.transpose() * across.normalized();
      const double here = across.normalized().dot(a);
      if (heights.maxCoeff() < here + 1e-9 || heights.minCoeff() > here - 1e-9)
        least = std::min(least, std::abs(here));
    }
return least;
// </solution>
