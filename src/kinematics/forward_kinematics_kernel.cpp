#include "base/lane_math.h"
#include "geometry/kernel_math.h"
#include "kinematics/forward_kinematics_kernel_internal.h"

namespace rex::internal {
namespace {

using Kind = MotionStep::Kind;

template <class T>
inline T coordinate(const MotionStep& step, const double* const* q) {
  return T(step.ratio) * gathered<T>(q, step.qIndex) + T(step.offset);
}

// The two numbers in which every joint motion except that of a quaternion is linear.
template <class T>
struct Factors {
  T first, second;
};

template <class T>
inline Factors<T> factors(const MotionStep& step, const double* const* q) {
  if (step.kind != Kind::kHinge && step.kind != Kind::kSlider) return {T(0.0), T(0.0)};
  const T x = coordinate<T>(step, q);
  if (step.kind == Kind::kSlider) return {x, T(0.0)};
  const SinCos<T> turn = sinCos(x);
  return {turn.cosine, turn.sine};
}

// X times the pose with these columns, one after the other, so that X stays in registers.
template <class T, class Column>
inline void storeProduct(const KernelPose<T>& X, const Column& column, double* to, int stride) {
  for (int i = 0; i < 9; i += 3) storeVec3(X.R * column(i), to + i * stride, stride);
  storeVec3(X.R * column(9) + X.p, to + 9 * stride, stride);
}

template <class T>
inline void place(const MotionStep& step, const Factors<T>& f, const double* const* q, const double* X_WP,
                  double* X_WC, int stride) {
  if (step.kind == Kind::kFixed && step.from == 0) {
    storePose(broadcastPose<T>(step.constant), X_WC, stride);
    return;
  }
  KernelPose<T> X = loadPose<T>(X_WP, stride);
  if (step.kind != Kind::kQuaternion) {
    const auto column = [&](int i) {
      return broadcastVec3<T>(step.constant + i) + f.first * broadcastVec3<T>(step.first + i) +
             f.second * broadcastVec3<T>(step.second + i);
    };
    storeProduct(X, column, X_WC, stride);
    return;
  }
  X = X * broadcastPose<T>(step.constant);
  X.R = X.R * rotationOfQuaternion<T>(q, step.qIndex);
  storeProduct(
      X, [&](int i) { return broadcastVec3<T>(step.first + i); }, X_WC, stride);
}

// Sines are independent of one another, but each pose needs the one before and would wait for its sine if
// they were interleaved: so some sines come first, then their poses. Flat, because the compiler would
// otherwise call sinCos() and pass its registers through memory.
template <class T, int kCount>
[[gnu::flatten]] void placeAll(const MotionStep* steps, int stepCount, const double* const* q, double* X_WB) {
  constexpr int kAhead = 16, kPacks = kCount / kLanesOf<T>;
  Factors<T> ahead[kAhead][kPacks];
  for (int begin = 0; begin < stepCount; begin += kAhead) {
    const int end = begin + kAhead < stepCount ? begin + kAhead : stepCount;
    for (int s = begin; s < end; ++s) {
      for (int i = 0; i < kPacks; ++i) ahead[s - begin][i] = factors<T>(steps[s], q + i * kLanesOf<T>);
    }
    for (int s = begin; s < end; ++s) {
      const double* X_WP = X_WB + MotionStep::kPoseSize * kCount * steps[s].from;
      double* X_WC = X_WB + MotionStep::kPoseSize * kCount * steps[s].to;
      for (int i = 0; i < kPacks; ++i) {
        const int k = i * kLanesOf<T>;
        place<T>(steps[s], ahead[s - begin][i], q + k, X_WP + k, X_WC + k, kCount);
      }
    }
  }
}

#ifdef __AVX__
// One configuration in lanes: four sines at once, and poses by columns. A pose stays in registers as long as
// the next one follows it.
inline PoseColumns moved(const PoseColumns& X, const MotionStep& step, const Factors<double>& f) {
  alignas(Quad) double motion[MotionStep::kPoseSize];
  for (int e = 0; e < MotionStep::kPoseSize; e += kLanesOf<Quad>)
    store(load<Quad>(step.constant + e) + Quad(f.first) * load<Quad>(step.first + e) +
              Quad(f.second) * load<Quad>(step.second + e),
          motion + e);
  return times(X, motion);
}

[[gnu::flatten]] void placeOne(const MotionStep* steps, int stepCount, const double* const* q, double* X_WB) {
  constexpr int kAhead = 16;
  PoseColumns X{};
  int at = -1;  // the body whose pose X is
  for (int begin = 0; begin < stepCount; begin += kAhead) {
    const int end = begin + kAhead < stepCount ? begin + kAhead : stepCount;
    double x[kAhead] = {}, sines[kAhead], cosines[kAhead];
    for (int s = begin; s < end; ++s)
      if (steps[s].kind == Kind::kHinge || steps[s].kind == Kind::kSlider)
        x[s - begin] = coordinate<double>(steps[s], q);
    sinesOf(x, end - begin, sines, cosines);
    for (int s = begin; s < end; ++s) {
      const MotionStep& step = steps[s];
      const double* const X_WP = X_WB + MotionStep::kPoseSize * step.from;
      double* const X_WC = X_WB + MotionStep::kPoseSize * step.to;
      if (step.kind == Kind::kQuaternion) {
        place<double>(step, {}, q, X_WP, X_WC, 1);
        at = -1;
        continue;
      }
      if (step.kind == Kind::kFixed && step.from == 0) {
        X = loadColumns(step.constant);
      } else {
        if (step.from != at) X = loadColumns(X_WP);
        const int i = s - begin;
        const Factors<double> f = step.kind == Kind::kHinge    ? Factors<double>{cosines[i], sines[i]}
                                  : step.kind == Kind::kSlider ? Factors<double>{x[i], 0}
                                                               : Factors<double>{0, 0};
        X = moved(X, step, f);
      }
      storeColumns(X, X_WC);
      at = step.to;
    }
  }
}
#endif

}  // namespace

template <int kLanes>
ForwardKinematicsKernel ForwardKinematicsKernel::compiled() {
  Place one = &placeAll<double, 1>;
#ifdef __AVX__
  one = &placeOne;
#endif
  return {one, &placeAll<InLanes<kLanes>, kBlock>};
}
template ForwardKinematicsKernel ForwardKinematicsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
