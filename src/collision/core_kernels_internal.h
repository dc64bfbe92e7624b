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

/// The gap between cores A and B: the nearest point of B, the unit normal from B to A, and the distance
/// along it to the nearest point of A; negative in overlap, as in Proximity.
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

/// Where a moving coordinate p_i + t d_i lies between two faces: the interval of t, and d_i squared.
template <class T>
struct Passage {
  Passage(const T& p_i, const T& d_i, const T& half_i) : weight(d_i * d_i) {
    const T inverse = T(1.0) / select(absolute(d_i) > T(1e-30), d_i, T(1e-30));
    const T middle = -p_i * inverse, reach = half_i * absolute(inverse);
    begin = middle - reach;
    end = middle + reach;
  }
  T begin, end, weight;
};

/// An interval of t in which the slope changes its sign, with its values at the ends.
template <class T>
struct Bracket {
  T low, high, atLow, atHigh;

  void narrow(const T& t, const T& slope) {
    const auto isBefore = slope < T(0.0);
    low = larger(low, select(isBefore, t, low));
    atLow = larger(atLow, select(isBefore, slope, atLow));
    high = smaller(high, select(isBefore, high, t));
    atHigh = smaller(atHigh, select(isBefore, atHigh, slope));
  }
};

/// The t in [-1, 1] for which p + t d is nearest to the box about the origin. The squared distance is convex,
/// and its slope linear between the crossings of the six faces: among these lies the root.
template <class T>
inline T nearestParameter(const Vec3<T>& p, const Vec3<T>& d, const Vec3<T>& half) {
  const T one(1.0);
  const Passage<T> x(p.x, d.x, half.x), y(p.y, d.y, half.y), z(p.z, d.z, half.z);
  const auto slope = [&](const T& t) {
    return x.weight * (t - clamped(t, x.begin, x.end)) + y.weight * (t - clamped(t, y.begin, y.end)) +
           z.weight * (t - clamped(t, z.begin, z.end));
  };
  Bracket<T> root{-one, one, slope(-one), slope(one)};
  const T atStart = root.atLow;
  const auto narrow = [&](const T& crossing) {
    const T t = clamped(crossing, -one, one);
    root.narrow(t, slope(t));
  };
  narrow(x.begin);
  narrow(x.end);
  narrow(y.begin);
  narrow(y.end);
  narrow(z.begin);
  narrow(z.end);
  const T steepness = larger(root.atHigh - root.atLow, T(kTiny));
  const T t = root.low - (root.high - root.low) * (root.atLow / steepness);
  return select(atStart < T(0.0), smaller(t, root.high), -one);
}

/// The direction in which two solids are apart by most, or overlap least.
template <class T>
struct Separation {
  Vec3<T> normal;
  T width;
};

/// Tries the direction n, of any length, for the box about the origin and the sum of the segments
/// c + t edges[k]. Whatever n is, the width is not more than the distance of the two.
template <int kEdges, class T>
inline void tryDirection(Separation<T>& best, const Vec3<T>& n, const Vec3<T>& half, const Vec3<T>& c,
                         const Vec3<T> (&edges)[kEdges]) {
  const T size2 = dot(n, n);
  const auto isDirection = size2 > T(1e-200);
  const T scale = T(1.0) / squareRoot(select(isDirection, size2, T(1.0)));
  const T along = dot(n, c);
  T reach = absolute(n.x) * half.x + absolute(n.y) * half.y + absolute(n.z) * half.z;
  for (const Vec3<T>& edge : edges) reach = reach + absolute(dot(n, edge));
  const T width = select(isDirection, scale * (absolute(along) - reach), T(-1e300));
  const auto isBetter = width > best.width;
  best.normal = select(isBetter, select(along < T(0.0), -scale, scale) * n, best.normal);
  best.width = select(isBetter, width, best.width);
}

/// Tries the faces of the box, and all pairs of its edges with the given ones.
template <int kEdges, class T>
inline Separation<T> separation(const Vec3<T>& half, const Vec3<T>& c, const Vec3<T> (&edges)[kEdges]) {
  const T zero(0.0), one(1.0);
  Separation<T> best{{zero, zero, one}, T(-1e300)};
  tryDirection(best, Vec3<T>{one, zero, zero}, half, c, edges);
  tryDirection(best, Vec3<T>{zero, one, zero}, half, c, edges);
  tryDirection(best, Vec3<T>{zero, zero, one}, half, c, edges);
  for (const Vec3<T>& edge : edges) {
    tryDirection(best, Vec3<T>{zero, -edge.z, edge.y}, half, c, edges);
    tryDirection(best, Vec3<T>{edge.z, zero, -edge.x}, half, c, edges);
    tryDirection(best, Vec3<T>{-edge.y, edge.x, zero}, half, c, edges);
  }
  return best;
}

/// A segment and a box. The shortest way out of an overlap is along the normal of a face, or across
/// an edge and the segment; then both touch in one point at least.
template <class T>
[[gnu::always_inline]] inline Gap<T> gap(const Segment<T>& A, const Box<T>& B) {
  const Vec3<T> p = transposedTimes(B.X.R, A.p - B.X.p), d = transposedTimes(B.X.R, A.d);
  const Vec3<T> x = p + nearestParameter(p, d, B.half) * d;
  Vec3<T> onBox = clampedTo(B.half, x);
  const Vec3<T> apart = x - onBox;
  T width = squareRoot(dot(apart, apart));
  Vec3<T> normal = (T(1.0) / larger(width, T(kTouching))) * apart;
  const auto isTouching = width <= T(kTouching);
  if (any(isTouching)) {
    const Vec3<T> edges[1] = {d};
    const Separation<T> out = separation(B.half, p, edges);
    const Vec3<T> moved = p - out.width * out.normal;
    const Vec3<T> touched = clampedTo(B.half, moved + nearestParameter(moved, d, B.half) * d);
    onBox = select(isTouching, touched, onBox);
    normal = select(isTouching, out.normal, normal);
    width = select(isTouching, out.width, width);
  }
  return {B.X.R * onBox + B.X.p, B.X.R * normal, width};
}

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

/// Two boxes. The 15 separating axes show whether they overlap, and how to get out: boxes that do are moved
/// apart first, and touch then. Of boxes apart, an edge of A or a corner of B is always among the nearest.
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

  // Squared distances tell the nearest points to half of the digits only; projecting once more gives the
  // rest.
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

/// Two segments. Each step is exact if the nearest points are no ends (Ericson, Real-Time Collision
/// Detection, 5.1.9).
template <class T>
[[gnu::always_inline]] inline Gap<T> gap(const Segment<T>& A, const Segment<T>& B) {
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
