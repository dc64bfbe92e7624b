#include "collision/convex_core_internal.h"
#include "collision/convex_distance_internal.h"
#include "collision/core_depth_internal.h"
#include "collision/core_gap_internal.h"

namespace rex::internal {

using Eigen::Vector3d;

CertifiedProximity certifiedProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  const ConvexCore coreA(a), coreB(b);
  const MinkowskiDifference difference(coreA, coreB, X_WA.inverse() * X_WB);
  CoreProximity cores = coreGap(difference);
  if (!(cores.distance > 0)) cores = coreDepth(difference, cores.nearest);

  // The points differ by the distance along the normal within the slack; half of the rest falls to each.
  const double distance = cores.distance - coreA.radius() - coreB.radius();
  const Vector3d normal_W = X_WA.R * cores.normal;
  const Vector3d middle_A = cores.nearest.onA - cores.nearest.x / 2;
  const Vector3d middle_W = X_WA * middle_A + (coreB.radius() - coreA.radius()) / 2 * normal_W;
  const Vector3d half_W = distance / 2 * normal_W;
  return {{distance, middle_W + half_W, middle_W - half_W, normal_W}, cores.slack};
}

Proximity convexProximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  return certifiedProximity(a, X_WA, b, X_WB).proximity;
}

bool isNearer(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB, double margin) {
  if (margin < 0) return !(convexProximity(a, X_WA, b, X_WB).distance >= margin);
  const ConvexCore coreA(a), coreB(b);
  const double cores = coreGap(MinkowskiDifference(coreA, coreB, X_WA.inverse() * X_WB)).distance;
  return !(cores > 0 && cores - coreA.radius() - coreB.radius() >= margin);
}

}  // namespace rex::internal
