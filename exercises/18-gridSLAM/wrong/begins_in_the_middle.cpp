// caught by: wake-up, more-wake-ups
// shown by: wake-up
// mistake: a match from the middle of the map.

// <solution located>
const Eigen::Vector2d middle =
    map.origin + .5 * map.cell * Eigen::Vector2d(map.values.rows(), map.values.cols());
return matched(wallDistances(map, settings.reach), scan, settings.deviation, {middle[0], middle[1], 0},
               {.4 * map.cell * static_cast<double>(map.values.rows()), 3});
// </solution>
