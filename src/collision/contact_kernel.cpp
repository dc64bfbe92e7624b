#include "collision/contact_kernel_internal.h"
#include "collision/core_kernels_internal.h"

namespace rex::internal {
namespace {

constexpr int kLane = kContactLanes;

// The numbers of a solid, starting at some lane.
struct Solid {
  Solid(const LaneSolids& all, int place, int lane)
      : X_WS(all.X_WS + place * kPoseNumbers + lane), size(all.size + place * kSizeNumbers + lane) {}

  template <class T>
  Vec3<T> axis(int i) const {
    return loadVec3<T>(X_WS + 3 * i * kLane, kLane);
  }
  template <class T>
  Vec3<T> origin() const {
    return loadVec3<T>(X_WS + 9 * kLane, kLane);
  }
  template <class T>
  T radius() const {
    return load<T>(size + 3 * kLane);
  }

  const double* X_WS;
  const double* size;
};

template <class T>
void loadCore(const Solid& solid, Segment<T>& core) {
  core = {solid.origin<T>(), load<T>(solid.size + 2 * kLane) * solid.axis<T>(2)};
}

template <class T>
void loadCore(const Solid& solid, Box<T>& core) {
  core = {loadPose<T>(solid.X_WS, kLane), loadVec3<T>(solid.size, kLane)};
}

template <class T, class A, class B>
Gap<T> gapOf(const Solid& a, const Solid& b) {
  A coreA;
  B coreB;
  loadCore(a, coreA);
  loadCore(b, coreB);
  return gap(coreA, coreB);
}

template <class T, class A, class B>
T distanceOf(const Solid& a, const Solid& b) {
  return gapOf<T, A, B>(a, b).width - a.radius<T>() - b.radius<T>();
}

template <class T, class A, class B>
void distances(const CorePair* pairs, int count, const LaneSolids& solids, double* distances) {
  for (const CorePair* pair = pairs; pair < pairs + count; ++pair) {
    for (int lane = 0; lane < kLane; lane += kLanesOf<T>) {
      const Solid a(solids, pair->a, lane), b(solids, pair->b, lane);
      store(distanceOf<T, A, B>(a, b), distances + pair->row * kLane + lane);
    }
  }
}

template <class T, class A, class B>
void proximities(const CorePair& pair, int lanes, const LaneSolids& solids, LaneProximities& found) {
  for (int lane = 0; lane < lanes; lane += kLanesOf<T>) {
    const Solid a(solids, pair.a, lane), b(solids, pair.b, lane);
    const Gap<T> gap = gapOf<T, A, B>(a, b);
    const T radiusA = a.radius<T>(), radiusB = b.radius<T>();
    store(gap.width - radiusA - radiusB, found.distance + lane);
    storeVec3(gap.p_B + (gap.width - radiusA) * gap.normal, found.p_WA + lane, kLane);
    storeVec3(gap.p_B + radiusB * gap.normal, found.p_WB + lane, kLane);
    storeVec3(gap.normal, found.normal_W + lane, kLane);
  }
}

// Whether a is smaller than b in some lane; NaN counts as small, so that it never counts as free.
template <class T>
bool isAnyBelow(const T& a, const T& b) {
  return any(select(a >= b, T(0.0), T(1.0)) > T(0.0));
}

// The lanes in which a is smaller than b, as bits.
template <class T>
unsigned lanesBelow(const T& a, const T& b) {
  double isBelow[kLanesOf<T>];
  store(select(a >= b, T(0.0), T(1.0)), isBelow);
  unsigned bits = 0;
  for (int i = 0; i < kLanesOf<T>; ++i) bits |= isBelow[i] != 0 ? 1u << i : 0u;
  return bits;
}

// Whether in some lane a vector may be no longer than `near`. A margin below zero can make that negative:
// then every vector is longer except zero, which stands for a point inside a box.
template <class T>
bool isAnyShorter(const Vec3<T>& apart, const T& near) {
  const T enough = absolute(near) + T(kCullSlack);
  return isAnyBelow(dot(apart, apart), enough * enough);
}

// Whether in some lane the bounding spheres of both solids are closer than the margin.
template <class T>
bool areSpheresNear(const Solid& a, const Solid& b, double reach, double margin) {
  return isAnyShorter(a.origin<T>() - b.origin<T>(), T(reach + margin));
}

// The same for the bounding sphere of a segment and the box itself.
template <class T>
bool isSphereNear(const Solid& segment, const Solid& box, double margin) {
  const Mat3<T> R{box.axis<T>(0), box.axis<T>(1), box.axis<T>(2)};
  const Vec3<T> p = transposedTimes(R, segment.origin<T>() - box.origin<T>());
  const Vec3<T> apart = p - clampedTo(loadVec3<T>(box.size, kLane), p);
  const T radius = load<T>(segment.size + 2 * kLane) + segment.radius<T>();
  return isAnyShorter(apart, radius + box.radius<T>() + T(margin));
}

template <class A, class B>
constexpr bool kIsSegmentAndBox = false;
template <class T>
constexpr bool kIsSegmentAndBox<Segment<T>, Box<T>> = true;

// The lanes, as bits, in which a pair is closer than the margin.
template <class T, class A, class B>
unsigned hitsOf(const Solid& a, const Solid& b, double reach, double margin) {
  if (!areSpheresNear<T>(a, b, reach, margin)) return 0;
  if constexpr (kIsSegmentAndBox<A, B>) {
    if (!isSphereNear<T>(a, b, margin)) return 0;
  }
  return lanesBelow(distanceOf<T, A, B>(a, b), T(margin));
}

template <class T, class A, class B>
unsigned hits(const CorePair* pairs, int count, const LaneSolids& solids, double margin, unsigned known,
              bool isOneEnough) {
  constexpr unsigned kAll = (1u << kLanesOf<T>)-1;
  unsigned found = known;
  for (int lane = 0; lane < kLane; lane += kLanesOf<T>) {
    unsigned here = found >> lane & kAll;
    for (const CorePair* pair = pairs; pair < pairs + count && here != kAll; ++pair) {
      const Solid a(solids, pair->a, lane), b(solids, pair->b, lane);
      here |= hitsOf<T, A, B>(a, b, pair->reach, margin);
      if (isOneEnough && (found | here << lane) != known) return found | here << lane;
    }
    found |= here << lane;
  }
  return found;
}

template <class T>
void placeShape(const double* X_WB, const double* X_BS, double* X_WS) {
  const auto column = [&](int i) { return Vec3<T>{T(X_BS[3 * i]), T(X_BS[3 * i + 1]), T(X_BS[3 * i + 2])}; };
  for (int lane = 0; lane < kLane; lane += kLanesOf<T>) {
    const KernelPose<T> X = loadPose<T>(X_WB + lane, kLane);
    for (int i = 0; i < 3; ++i) storeVec3(X.R * column(i), X_WS + 3 * i * kLane + lane, kLane);
    storeVec3(X.R * column(3) + X.p, X_WS + 9 * kLane + lane, kLane);
  }
}

template <class T, class A, class B>
constexpr PairKernel pairKernel() {
  return {&distances<T, A, B>, &proximities<T, A, B>, &hits<T, A, B>};
}

}  // namespace

template <int kLanes>
ContactKernel ContactKernel::compiled() {
  using T = InLanes<kLanes>;
  return {&placeShape<T>,
          {pairKernel<T, Segment<T>, Segment<T>>(), pairKernel<T, Segment<T>, Box<T>>(),
           pairKernel<T, Box<T>, Box<T>>()}};
}
template ContactKernel ContactKernel::compiled<REX_LANES>();

}  // namespace rex::internal
