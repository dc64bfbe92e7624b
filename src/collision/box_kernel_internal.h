#pragma once

#include "collision/core_kernel_internal.h"

namespace rex {
namespace {

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

/// A segment and a box. In overlap, what moves the segment out soonest is a direction across a face, or
/// across an edge and the segment; then both touch in one point at least.
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

}  // namespace
}  // namespace rex
