// caught by: wake-up, more-wake-ups
// mistake: the robot looks along x.

// <solution located>
// Wide enough that a pose half a cell beside the right one still fits better than most.
const Grid wide = wallDistances(map, 2 * settings.reach), distances = wallDistances(map, settings.reach);
std::vector<std::pair<double, Eigen::Vector3d>> candidates;
for (Eigen::Index i = 0; i < map.values.rows(); i += 2)
  for (Eigen::Index j = 0; j < map.values.cols(); j += 2)
    for (int k = 0; k < 1 && map.values(i, j) < 0; ++k) {
      const Eigen::Vector3d coarse(map.origin[0] + map.cell * (static_cast<double>(i) + .5),
                                   map.origin[1] + map.cell * (static_cast<double>(j) + .5),
                                   std::acos(-1) / 18 * k);
      candidates.emplace_back(fit(wide, coarse, scan, 2 * settings.deviation), coarse);
    }
std::sort(candidates.begin(), candidates.end(),
          [](const auto& one, const auto& other) { return one.first > other.first; });
Eigen::Vector3d best = Eigen::Vector3d::Zero();
double score = -1e300;
for (std::size_t k = 0; k < std::min<std::size_t>(candidates.size(), 30); ++k) {
  const Eigen::Vector3d match =
      matched(distances, scan, settings.deviation, candidates[k].second, {1.5 * map.cell, .15});
  const double value = fit(distances, match, scan, settings.deviation);
  if (value > score) best = match, score = value;
}
return best;
// </solution>
