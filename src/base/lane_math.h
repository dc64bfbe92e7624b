#pragma once

#include "base/pack.h"

namespace rex {
namespace {

/// factors[0] + factors[1] z + factors[2] z^2 + ..., for kernels; see base/pack.h.
template <int kCount, class T>
inline T polynomial(const double (&factors)[kCount], const T& z) {
  T sum(factors[kCount - 1]);
  for (int i = kCount - 2; i >= 0; --i) sum = T(factors[i]) + z * sum;
  return sum;
}

}  // namespace
}  // namespace rex

// Exponential and logarithm for kernels; see base/pack.h. The standard library's bits differ between CPUs.
namespace rex {
namespace {

/// (exp(r) - 1 - r) / r^2 in r for |r| <= log(2) / 2, and (log((1 + s) / (1 - s)) - 2 s) / s^3 in s^2 for
/// |s| <= .1716: polynomials that agree with them at the Chebyshev nodes. Their errors are 1.4e-17 and
/// 1.6e-18, relative to the functions that they are part of.
inline constexpr double kExpSeries[] = {0x1.0000000000001p-1,  0x1.5555555555556p-3,  0x1.5555555553d37p-5,
                                        0x1.11111111109a6p-7,  0x1.6c16c1789d1d7p-10, 0x1.a01a01a7cebcdp-13,
                                        0x1.a019b8ca26fcfp-16, 0x1.71de0d85293b8p-19, 0x1.2891d4ffbb0f9p-22,
                                        0x1.af390ba7e6f47p-26};
inline constexpr double kLogSeries[] = {0x1.5555555555558p-1, 0x1.9999999995273p-2, 0x1.2492492dfd86cp-2,
                                        0x1.c71c62d5e53e0p-3, 0x1.7462b91b8df65p-3, 0x1.39fdcceb4bb45p-3,
                                        0x1.2b5f68a50d903p-3};
/// log(2) in two parts, the first of 33 bits, so that its products with whole numbers are exact.
inline constexpr double kLog2High = 0x1.62e42fefp-1, kLog2Low = 0x1.473de6af278edp-34;

/// exp(x) for x <= 709, with a relative error of 3e-16; 0 below -708.
template <class T>
inline T exponential(const T& x) {
  constexpr double kPerLog2 = 0x1.71547652b82fep+0, kLeast = -708;
  // Adding it to a number rounds that to an integer, which is then in the last bits.
  constexpr double kRounding = 0x1.8p52;
  const T rounded = larger(x, T(kLeast)) * T(kPerLog2) + T(kRounding);
  const T n = rounded - T(kRounding);
  const T r = x - n * T(kLog2High) - n * T(kLog2Low);
  const T scale = fromBits<T>((bitsOf(rounded) << 52) + 0x3ff0000000000000);
  const T result = (T(1.0) + (r + r * r * polynomial(kExpSeries, r))) * scale;
  return select(x < T(kLeast), T(0.0), result);
}

/// log(x) for positive normal x (at least 2.3e-308), with a relative error of 4e-16.
template <class T>
inline T logarithm(const T& x) {
  constexpr long long kRootOfHalf = 0x3fe6a09e667f3bcd, kFraction = 0x000fffffffffffff;
  // x = 2^e m with m from sqrt(1/2) to sqrt(2). A whole number k in the last bits of 2^52 makes 2^52 + k.
  constexpr long long kBias = 1023, kTwoTo52 = 0x4330000000000000;
  const auto bits = bitsOf(x) - kRootOfHalf;
  const auto biased = (bits + (kBias << 52)) >> 52;
  const T e = fromBits<T>(biased | kTwoTo52) - T(0x1p52 + kBias);
  const T f = fromBits<T>((bits & kFraction) + kRootOfHalf) - T(1.0);
  const T s = f / (T(2.0) + f);
  const T z = s * s;
  return e * T(kLog2High) + (T(2.0) * s + (s * z * polynomial(kLogSeries, z) + e * T(kLog2Low)));
}

}  // namespace
}  // namespace rex

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
