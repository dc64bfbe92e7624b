// caught by: distances, more-fits
// mistake: distances are counted in cells.

// <solution wallDistances>
const Eigen::Index width = map.values.rows(), height = map.values.cols();
const auto around = static_cast<Eigen::Index>(std::ceil(reach / map.cell));
for (Eigen::Index j = 0; j < height; ++j)
  for (Eigen::Index i = 0; i < width; ++i) {
    if (map.values(i, j) <= 0) continue;
    for (Eigen::Index y = std::max<Eigen::Index>(j - around, 0); y <= std::min(j + around, height - 1); ++y)
      for (Eigen::Index x = std::max<Eigen::Index>(i - around, 0); x <= std::min(i + around, width - 1); ++x)
        distances.values(x, y) = std::min(
            distances.values(x, y), std::sqrt(static_cast<double>((x - i) * (x - i) + (y - j) * (y - j))));
  }
// </solution>
