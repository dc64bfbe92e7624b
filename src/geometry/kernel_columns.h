#pragma once

#include "base/pack.h"
#include "base/sin_cos.h"

// One pose in lanes, for kernels of four: its columns, each in the first three lanes of a pack. All numbers
// have the bits that kernel_math.h gives. See base/pack.h for the reason for the anonymous namespace.
#ifdef __AVX__
namespace rex {
namespace {

using Quad = Pack<4>;

/// The fourth lanes are arbitrary.
struct PoseColumns {
  Quad x, y, z, p;
};

/// The layout of rex::Pose: twelve numbers.
inline PoseColumns loadColumns(const double* X) {
  const Quad end = load<Quad>(X + 8);
  return {load<Quad>(X), load<Quad>(X + 3), load<Quad>(X + 6),
          __builtin_shufflevector(end.numbers, end.numbers, 1, 2, 3, 3)};
}

/// Stores two columns one after the other, six numbers; the second store overwrites the fourth lane of a.
inline void storePair(const Quad& a, const Quad& b, double* to) {
  store(a, to);
  store(Quad(__builtin_shufflevector(a.numbers, b.numbers, 2, 4, 5, 6)), to + 2);
}
inline void storeColumns(const PoseColumns& X, double* to) {
  storePair(X.x, X.y, to);
  storePair(X.z, X.p, to + 6);
}

/// R v.
inline Quad turned(const PoseColumns& X, const double* v) {
  return X.x * Quad(v[0]) + X.y * Quad(v[1]) + X.z * Quad(v[2]);
}

/// X times the pose at `motion`, which has the layout of rex::Pose.
inline PoseColumns times(const PoseColumns& X, const double* motion) {
  return {turned(X, motion), turned(X, motion + 3), turned(X, motion + 6), turned(X, motion + 9) + X.p};
}

/// Sines and cosines of `count` angles, four at once; all three have room for whole packs.
inline void sinesOf(const double* angles, int count, double* sines, double* cosines) {
  for (int i = 0; i < count; i += kLanesOf<Quad>) {
    const SinCos<Quad> turn = sinCos(load<Quad>(angles + i));
    store(turn.sine, sines + i);
    store(turn.cosine, cosines + i);
  }
}

inline Quad crossColumns(const Quad& a, const Quad& b) {
  const auto yzx = [](const Quad& v) { return __builtin_shufflevector(v.numbers, v.numbers, 1, 2, 0, 3); };
  const auto zxy = [](const Quad& v) { return __builtin_shufflevector(v.numbers, v.numbers, 2, 0, 1, 3); };
  return yzx(a) * zxy(b) - zxy(a) * yzx(b);
}

}  // namespace
}  // namespace rex
#endif
