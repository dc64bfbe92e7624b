// caught by: forbidden-call
// mistake: lets the library follow the rays.

// <solution headers>
#include "estimation/occupancy_map.h"
// </solution>

// <solution observed>
OccupancyMap cells(static_cast<int>(map.values.rows()), static_cast<int>(map.values.cols()), map.cell,
                   map.origin);
const RangeScanner scanner{{scan.angles.data(), scan.angles.data() + scan.angles.size()}, scan.maxRange};
cells.observe(scanner, pose, scan.ranges);
for (int i = 0; i < cells.width(); ++i)
  for (int j = 0; j < cells.height(); ++j)
    after.values(i, j) = std::clamp(map.values(i, j) + cells.logOdds(i, j), -evidence.bound, evidence.bound);
// </solution>
