#pragma once

#include "base/polynomial.h"

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
