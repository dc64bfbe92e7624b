#pragma once

#include "collision/core_kernel_internal.h"

namespace rex {
namespace {

/// A unit vector across v, which may be zero.
template <class T>
inline Vec3<T> across(const Vec3<T>& v) {
  const T x2 = v.x * v.x, y2 = v.y * v.y, z2 = v.z * v.z, zero(0.0);
  const T acrossX = y2 + z2, acrossY = x2 + z2;
  const auto useX = acrossX > acrossY;
  const T size2 = select(useX, acrossX, acrossY);
  const T scale = T(1.0) / squareRoot(select(size2 > T(kTiny), size2, T(1.0)));
  const Vec3<T> unit = scale * select(useX, Vec3<T>{zero, v.z, -v.y}, Vec3<T>{-v.z, zero, v.x});
  return select(size2 > T(kTiny), unit, Vec3<T>{zero, zero, T(1.0)});
}

/// A unit vector across a and b, which are at right angles, or zero.
template <class T>
inline Vec3<T> acrossBoth(const Vec3<T>& a, const Vec3<T>& b) {
  const Vec3<T> n = cross(a, b);
  const T size2 = dot(n, n);
  const auto isDirection = size2 > T(kTiny);
  const Vec3<T> unit = (T(1.0) / squareRoot(select(isDirection, size2, T(1.0)))) * n;
  return select(isDirection, unit, across(select(dot(a, a) > dot(b, b), a, b)));
}

/// Two segments. Each step is exact where the others meet no end (Ericson, Real-Time Collision Detection,
/// 5.1.9).
template <class T>
inline Gap<T> gap(const Segment<T>& A, const Segment<T>& B) {
  const T one(1.0), ab = dot(A.d, B.d);
  const T aa = larger(dot(A.d, A.d), T(kTiny)), bb = larger(dot(B.d, B.d), T(kTiny));
  const Vec3<T> r = A.p - B.p;
  const T ra = dot(r, A.d);
  // Where the lines are nearest, as seen along A: the usual quotient of inner products would lose half of the
  // digits where they are nearly parallel.
  const Vec3<T> seen = B.d - (ab / aa) * A.d, rSeen = r - (ra / aa) * A.d;
  const T seen2 = dot(seen, seen);
  const T onLine = select(seen2 > T(1e-28) * bb, dot(rSeen, seen) / larger(seen2, T(kTiny)), T(0.0));
  const T s = clamped((clamped(onLine, -one, one) * ab - ra) / aa, -one, one);
  const T t = clamped((s * ab + dot(r, B.d)) / bb, -one, one);

  const Vec3<T> p_B = B.p + t * B.d, apart = A.p + s * A.d - p_B;
  const T width = squareRoot(dot(apart, apart));
  const auto isApart = width > T(kTouching);
  Vec3<T> normal = (one / larger(width, T(kTouching))) * apart;
  if (any(width <= T(kTouching))) normal = select(isApart, normal, acrossBoth(A.d, seen));
  return {p_B, normal, width};
}

}  // namespace
}  // namespace rex
