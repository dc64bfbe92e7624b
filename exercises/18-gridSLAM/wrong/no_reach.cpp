// caught by: distances, more-fits
// mistake: far from walls, distances are not limited.

// <solution wallDistances>
for (Eigen::Index j = 0; j < map.values.cols(); ++j)
  for (Eigen::Index i = 0; i < map.values.rows(); ++i) {
    double nearest = 1e6;
    for (Eigen::Index y = 0; y < map.values.cols(); ++y)
      for (Eigen::Index x = 0; x < map.values.rows(); ++x)
        if (map.values(x, y) > 0)
          nearest = std::min(nearest,
                             map.cell * std::hypot(static_cast<double>(x - i), static_cast<double>(y - j)));
    distances.values(i, j) = nearest;
  }
// </solution>
