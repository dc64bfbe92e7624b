#pragma once

#include "geometry/kernel_math.h"

// Solids are cores swept by balls: a core is a segment (of a sphere: of no length) or a box.
namespace rex {
namespace {

/// The points p + t d with -1 <= t <= 1, in W.
template <class T>
struct Segment {
  Vec3<T> p, d;
};

/// A box by its pose in W and its half edge lengths.
template <class T>
struct Box {
  KernelPose<T> X;
  Vec3<T> half;
};

/// How two cores A and B lie to one another: the nearest point of B, the unit vector from B to A, and how far
/// it is along it to the nearest point of A; negative in overlap, as in Proximity.
template <class T>
struct Gap {
  Vec3<T> p_B, normal;
  T width;
};

/// Cores nearer than this touch: their difference gives no direction any more.
inline constexpr double kTouching = 1e-12;
/// Keeps divisors from being zero.
inline constexpr double kTiny = 1e-300;

template <class Mask, class T>
inline Vec3<T> select(const Mask& mask, const Vec3<T>& a, const Vec3<T>& b) {
  return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// The point of the box about the origin that is nearest to x.
template <class T>
inline Vec3<T> clampedTo(const Vec3<T>& half, const Vec3<T>& x) {
  return {clamped(x.x, -half.x, half.x), clamped(x.y, -half.y, half.y), clamped(x.z, -half.z, half.z)};
}

}  // namespace
}  // namespace rex
