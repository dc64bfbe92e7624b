#pragma once

#include "collision/box_kernel_internal.h"

namespace rex {
namespace {

/// Points of two boxes that are near one another, in the frame of B.
template <class T>
struct NearPoints {
  Vec3<T> onA, onB;
  T distance2;
};

template <class T>
inline void keepNearer(NearPoints<T>& best, const Vec3<T>& onA, const Vec3<T>& onB) {
  const Vec3<T> apart = onA - onB;
  const T distance2 = dot(apart, apart);
  const auto isNearer = distance2 < best.distance2;
  best.onA = select(isNearer, onA, best.onA);
  best.onB = select(isNearer, onB, best.onB);
  best.distance2 = select(isNearer, distance2, best.distance2);
}

/// Tries the four edges of A along `edge`: p_A +- u +- v + t edge, from the frame of box B.
template <class T>
inline void tryEdges(NearPoints<T>& best, const Vec3<T>& p_A, const Vec3<T>& u, const Vec3<T>& v,
                     const Vec3<T>& edge, const Vec3<T>& half_B) {
  const Vec3<T> middles[4] = {p_A + u + v, p_A + u - v, p_A - u + v, p_A - u - v};
  for (const Vec3<T>& p : middles) {
    const Vec3<T> x = p + nearestParameter(p, edge, half_B) * edge;
    keepNearer(best, x, clampedTo(half_B, x));
  }
}

/// The point of box A, which stands at X, that is nearest to x.
template <class T>
inline Vec3<T> nearestOn(const KernelPose<T>& X, const Vec3<T>& half, const Vec3<T>& x) {
  return X.R * clampedTo(half, transposedTimes(X.R, x - X.p)) + X.p;
}

/// Tries the eight corners of B.
template <class T>
inline void tryCorners(NearPoints<T>& best, const KernelPose<T>& X, const Vec3<T>& half_A,
                       const Vec3<T>& half_B) {
  for (int i = 0; i < 8; ++i) {
    const Vec3<T> corner{i & 1 ? half_B.x : -half_B.x, i & 2 ? half_B.y : -half_B.y,
                         i & 4 ? half_B.z : -half_B.z};
    keepNearer(best, nearestOn(X, half_A, corner), corner);
  }
}

/// Two boxes. The 15 separating directions tell whether they overlap, and how to get out: what touches last
/// is found by moving A out. Of boxes apart, an edge of A or a corner of B is always among the nearest.
template <class T>
inline Gap<T> gap(const Box<T>& A, const Box<T>& B) {
  const Mat3<T> R{transposedTimes(B.X.R, A.X.R.c0), transposedTimes(B.X.R, A.X.R.c1),
                  transposedTimes(B.X.R, A.X.R.c2)};
  const Vec3<T> p = transposedTimes(B.X.R, A.X.p - B.X.p);
  const Vec3<T> edges[3] = {A.half.x * R.c0, A.half.y * R.c1, A.half.z * R.c2};
  Separation<T> out = separation(B.half, p, edges);
  tryDirection(out, R.c0, B.half, p, edges);
  tryDirection(out, R.c1, B.half, p, edges);
  tryDirection(out, R.c2, B.half, p, edges);

  const KernelPose<T> moved{R, p - smaller(out.width, T(0.0)) * out.normal};
  NearPoints<T> near{p, p, T(1e300)};
  tryEdges(near, moved.p, edges[1], edges[2], edges[0], B.half);
  tryEdges(near, moved.p, edges[2], edges[0], edges[1], B.half);
  tryEdges(near, moved.p, edges[0], edges[1], edges[2], B.half);
  tryCorners(near, moved, A.half, B.half);

  // Squared distances tell the nearest points to half of the digits only; the rest comes from looking back.
  near.onA = nearestOn(moved, A.half, near.onB);
  near.onB = clampedTo(B.half, near.onA);
  const Vec3<T> apart = near.onA - near.onB;
  const T distance = squareRoot(dot(apart, apart));
  const auto isApart = out.width > T(kTouching);
  const Vec3<T> direction = (T(1.0) / larger(distance, T(kTouching))) * apart;
  // No direction has a width where a pose is not a number.
  const T width = select(out.width > T(-1e300), out.width, T(__builtin_nan("")));
  return {B.X.R * near.onB + B.X.p, B.X.R * select(isApart, direction, out.normal),
          select(isApart, distance, width)};
}

}  // namespace
}  // namespace rex
