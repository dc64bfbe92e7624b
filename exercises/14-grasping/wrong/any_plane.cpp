// caught by: radius, any-radius
// mistake: the nearest plane through three wrenches, whether it bounds the hull or cuts it.

// <solution epsilonOf>
if (!judged(wrenches).closed) return 0;
double least = INFINITY;
for (Eigen::Index i = 0; i < wrenches.cols(); ++i)
  for (Eigen::Index j = 0; j < i; ++j)
    for (Eigen::Index k = 0; k < j; ++k) {
      const Eigen::Vector3d a = wrenches.col(i), b = wrenches.col(j), c = wrenches.col(k);
      const Eigen::Vector3d across = (b - a).cross(c - a);
      if (across.norm() > 1e-9) least = std::min(least, std::abs(across.normalized().dot(a)));
    }
return least;
// </solution>
