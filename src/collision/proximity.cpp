#include "collision/proximity.h"

#include "collision/convex_core_internal.h"
#include "collision/convex_distance_internal.h"
#include "collision/core_kernels_internal.h"

namespace rex {
namespace {

using internal::Core;
using internal::CoreType;

Eigen::Vector3d toEigen(const Vec3<double>& v) { return {v.x, v.y, v.z}; }
Vec3<double> toKernel(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Segment<double> segment(const Core& core, const Pose& X_WC) {
  return {toKernel(X_WC.p), toKernel(X_WC.R.col(2) * core.half.z())};
}

Box<double> box(const Core& core, const Pose& X_WC) {
  const auto& R = X_WC.R;
  return {{{toKernel(R.col(0)), toKernel(R.col(1)), toKernel(R.col(2))}, toKernel(X_WC.p)},
          toKernel(core.half)};
}

Proximity swapped(const Proximity& p) { return {p.distance, p.p_WB, p.p_WA, -p.normal_W}; }

Proximity swept(const Gap<double>& gap, double radius_A, double radius_B) {
  const Eigen::Vector3d normal_W = toEigen(gap.normal), p_WB = toEigen(gap.p_B);
  return {gap.width - radius_A - radius_B, p_WB + (gap.width - radius_A) * normal_W,
          p_WB + radius_B * normal_W, normal_W};
}

Proximity between(const Core& a, const Pose& X_WA, const Core& b, const Pose& X_WB) {
  if (a.type == CoreType::kBox && b.type == CoreType::kSegment) return swapped(between(b, X_WB, a, X_WA));
  if (a.type == CoreType::kBox) return swept(gap(box(a, X_WA), box(b, X_WB)), a.radius, b.radius);
  if (b.type == CoreType::kBox) return swept(gap(segment(a, X_WA), box(b, X_WB)), a.radius, b.radius);
  return swept(gap(segment(a, X_WA), segment(b, X_WB)), a.radius, b.radius);
}

}  // namespace

Proximity proximity(const Shape& a, const Pose& X_WA, const Shape& b, const Pose& X_WB) {
  internal::requireSolid("proximity", a);
  internal::requireSolid("proximity", b);
  const Core coreA = internal::coreOf(a), coreB = internal::coreOf(b);
  if (coreA.type == CoreType::kOther || coreB.type == CoreType::kOther)
    return internal::convexProximity(a, X_WA, b, X_WB);
  return between(coreA, X_WA, coreB, X_WB);
}

}  // namespace rex
