#pragma once

#include "collision/core_kernel_internal.h"

namespace rex {
namespace {

/// d/dt of half the squared distance of p + t d from the box about the origin.
template <class T>
inline T slope(const Vec3<T>& p, const Vec3<T>& d, const Vec3<T>& half, const T& t) {
  const Vec3<T> x = p + t * d;
  return dot(x - clampedTo(half, x), d);
}

/// The t in [-1, 1] for which p + t d is nearest to the box about the origin. The slope is linear between the
/// crossings of the planes of the six faces: each crossing narrows the interval in which it changes its sign.
template <class T>
inline T nearestParameter(const Vec3<T>& p, const Vec3<T>& d, const Vec3<T>& half) {
  T low(-1.0), high(1.0);
  T atLow = slope(p, d, half, low), atHigh = slope(p, d, half, high);
  const auto narrow = [&](const T& crossing) {
    const T t = clamped(crossing, low, high), at = slope(p, d, half, t);
    const auto ahead = at < T(0.0);
    low = select(ahead, t, low);
    atLow = select(ahead, at, atLow);
    high = select(ahead, high, t);
    atHigh = select(ahead, atHigh, at);
  };
  const auto narrowByFaces = [&](const T& p_i, const T& d_i, const T& half_i) {
    const T inverse = T(1.0) / select(absolute(d_i) > T(1e-30), d_i, T(1e-30));
    narrow((-half_i - p_i) * inverse);
    narrow((half_i - p_i) * inverse);
  };
  narrowByFaces(p.x, d.x, half.x);
  narrowByFaces(p.y, d.y, half.y);
  narrowByFaces(p.z, d.z, half.z);
  const T root = low - (high - low) * (atLow / larger(atHigh - atLow, T(kTiny)));
  return select(atLow < T(0.0), smaller(root, high), low);
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
inline Gap<T> gap(const Segment<T>& A, const Box<T>& B) {
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
