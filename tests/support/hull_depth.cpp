#include "support/hull_depth.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace rex {

double hullDepth(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> coordinates;
  for (const Eigen::Vector3d& p : points) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  qhT qhull{};
  qh_zero(&qhull, stderr);
  char options[] = "qhull Qt";
  if (qh_new_qhull(&qhull, 3, static_cast<int>(points.size()), coordinates.data(), False, options, nullptr,
                   stderr) != 0)
    throw std::logic_error("qhull found no hull");
  double depth = std::numeric_limits<double>::infinity();
  for (facetT* facet = qhull.facet_list; facet && facet->next; facet = facet->next)
    depth = std::min(depth, -facet->offset);
  qh_freeqhull(&qhull, qh_ALL);
  int leftBlocks = 0, leftBytes = 0;
  qh_memfreeshort(&qhull, &leftBlocks, &leftBytes);
  return depth;
}

}  // namespace rex
