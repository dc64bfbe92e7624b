#pragma once

#include "base/lane_math.h"

// Normal numbers for kernels; see base/pack.h. Each lane draws from a sequence of its own, so what it gets
// does not depend on the others; and all operations are ours, so that it is the same on every CPU.
namespace rex::internal {
namespace {

// Spelled out for the reason that LaneTypes is.
template <int kLanes>
struct RandomBitsType;
template <>
struct RandomBitsType<1> {
  typedef unsigned long long Type;
};
template <>
struct RandomBitsType<2> {
  typedef unsigned long long Type __attribute__((vector_size(16)));
};
template <>
struct RandomBitsType<4> {
  typedef unsigned long long Type __attribute__((vector_size(32)));
};
/// 64 bits per lane of a T.
template <class T>
using RandomBits = typename RandomBitsType<kLanesOf<T>>::Type;

template <class Bits>
inline Bits rotatedLeft(Bits x, int by) {
  return (x << by) | (x >> (64 - by));
}

/// A generator per lane, the same as Rng: xoshiro256** (Blackman and Vigna, 2018).
template <class T>
struct LaneRng {
  RandomBits<T> state[4];

  RandomBits<T> next() {
    const RandomBits<T> five = state[1] + (state[1] << 2);
    const RandomBits<T> turned = rotatedLeft(five, 7), result = turned + (turned << 3);
    const RandomBits<T> shifted = state[1] << 17;
    state[2] ^= state[0];
    state[3] ^= state[1];
    state[1] ^= state[2];
    state[0] ^= state[3];
    state[2] ^= shifted;
    state[3] = rotatedLeft(state[3], 45);
    return result;
  }
};

template <class T>
struct NormalPair {
  T first, second;
};

/// Two independent standard normals of two draws, by Box and Muller (1958).
template <class T>
inline NormalPair<T> normalPair(RandomBits<T> one, RandomBits<T> other) {
  constexpr unsigned long long kOne = 0x3ff0000000000000;
  constexpr double kTwoPi = 0x1.921fb54442d18p+2;
  const T u = T(2.0) - fromBits<T>((one >> 12) | kOne);    // (0, 1]
  const T v = fromBits<T>((other >> 12) | kOne) - T(1.0);  // [0, 1)
  const T radius = squareRoot(T(-2.0) * logarithm(u));
  const SinCos<T> direction = sinCos(T(kTwoPi) * v);
  return {radius * direction.cosine, radius * direction.sine};
}

/// The next pair of any generator with one lane.
template <class Generator>
inline NormalPair<double> normalPair(Generator& rng) {
  const auto one = rng.next();
  return normalPair<double>(one, rng.next());
}

}  // namespace
}  // namespace rex::internal
