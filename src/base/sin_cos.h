#pragma once

#include "base/polynomial.h"

// Sine and cosine for kernels; see base/pack.h. The standard library's bits differ between CPUs.
namespace rex {
namespace {

inline constexpr int kSeriesTerms = 6;
/// (sin(r)/r - 1) / r^2 and (cos(r) - 1 + r^2/2) / r^4 as polynomials in r^2, which agree with them at the
/// Chebyshev nodes for |r| <= pi/4. The errors of sine and cosine are 1.4e-17 and 9e-19.
inline constexpr double kSineSeries[kSeriesTerms] = {-0x1.5555555555555p-3,  0x1.1111111110bb1p-7,
                                                     -0x1.a01a019e8357dp-13, 0x1.71de37961e4c6p-19,
                                                     -0x1.ae600a926c89ap-26, 0x1.5e0af186af739p-33};
inline constexpr double kCosineSeries[kSeriesTerms] = {0x1.5555555555555p-5,  -0x1.6c16c16c16966p-10,
                                                       0x1.a01a019f4e867p-16, -0x1.27e4fa17a41b4p-22,
                                                       0x1.1eeb68b109173p-29, -0x1.907d7aebd5e3dp-37};

template <class T>
struct SinCos {
  T sine, cosine;
};

// Uses the standard library in lanes where the angle is large or not a number.
template <class T>
inline SinCos<T> withLargeAngles(const T& angle, double limit, const SinCos<T>& result) {
  double angles[kLanesOf<T>], sines[kLanesOf<T>], cosines[kLanesOf<T>];
  store(angle, angles);
  store(result.sine, sines);
  store(result.cosine, cosines);
  for (int i = 0; i < kLanesOf<T>; ++i) {
    if (absolute(angles[i]) < limit) continue;
    sines[i] = __builtin_sin(angles[i]);
    cosines[i] = __builtin_cos(angles[i]);
  }
  return {load<T>(sines), load<T>(cosines)};
}

/// The largest angle for sinCosBelowLimit().
inline constexpr double kAngleLimit = 1e5;

/// As sinCos(), of angles below kAngleLimit in all lanes.
template <class T>
inline SinCos<T> sinCosBelowLimit(const T& angle) {
  // pi/2 in three parts (Cody and Waite 1980); the first two have 33 bits, so their products with n are
  // exact.
  constexpr double kPart1 = 0x1.921fb544p+0, kPart2 = 0x1.0b4611a6p-34, kPart3 = 0x1.3198a2e037073p-69;
  constexpr double kQuartersPerRadian = 0x1.45f306dc9c883p-1;
  // Adding it to a number rounds that to an integer, which is then in the last bits.
  constexpr double kRounding = 0x1.8p52;

  const T rounded = angle * T(kQuartersPerRadian) + T(kRounding);
  const T n = rounded - T(kRounding);
  const T r = angle - n * T(kPart1) - n * T(kPart2) - n * T(kPart3);  // |r| <= pi/4
  const T z = r * r;
  const auto sine = bitsOf(r + r * z * polynomial(kSineSeries, z));
  const auto cosine = bitsOf(T(1.0) - T(0.5) * z + z * z * polynomial(kCosineSeries, z));

  // An odd quarter swaps the two; bit 1 of the quarter is the sign of the sine, bit 1 of the next quarter
  // that of the cosine.
  const auto quarter = bitsOf(rounded);
  const auto swap = (sine ^ cosine) & -(quarter & 1);
  return {fromBits<T>(sine ^ swap ^ ((quarter & 2) << 62)),
          fromBits<T>(cosine ^ swap ^ (((quarter + 1) & 2) << 62))};
}

template <class T>
inline bool isBelowLimit(const T& angle) {
  return all(absolute(angle) < T(kAngleLimit));
}

/// Sine and cosine of an angle in radians, with an error of 3e-16.
template <class T>
inline SinCos<T> sinCos(const T& angle) {
  const SinCos<T> result = sinCosBelowLimit(angle);
  return isBelowLimit(angle) ? result : withLargeAngles(angle, kAngleLimit, result);
}

}  // namespace
}  // namespace rex
