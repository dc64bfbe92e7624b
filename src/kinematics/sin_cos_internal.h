#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

namespace rex {

struct SinCos {
  double sine, cosine;
};

/// 1/(2i+1)! and 1/(2i)!, the sizes of the terms of sin(r) / r and cos(r), for i = 0 ... 8.
inline constexpr auto kSeries = [] {
  std::array<std::array<double, 2>, 9> terms{};
  double factorial = 1;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const double even = 2. * static_cast<double>(i);
    if (i > 0) factorial *= (even - 1) * even;
    terms[i] = {1 / (factorial * (even + 1)), 1 / factorial};
  }
  return terms;
}();

/// Sine and cosine of an angle in radians, to 3e-16. Twice as fast as the library's where many follow one
/// another, because it neither calls nor branches on the quadrant.
inline SinCos sinCos(double angle) {
  // pi/2 in three parts (Cody and Waite 1980); the first two have 33 bits, so their products with n are
  // exact.
  constexpr double kPart1 = 0x1.921fb544p+0, kPart2 = 0x1.0b4611a6p-34, kPart3 = 0x1.3198a2e037073p-69;
  constexpr double kQuartersPerRadian = 0x1.45f306dc9c883p-1, kLargest = 1e5;
  if (!(std::abs(angle) < kLargest)) return {std::sin(angle), std::cos(angle)};

  const long quarter = std::lrint(angle * kQuartersPerRadian);
  const double n = static_cast<double>(quarter);
  const double r = angle - n * kPart1 - n * kPart2 - n * kPart3;  // |r| <= pi/4

  // Taylor's series of sin(r) / r and cos(r) side by side; the first terms left out are below 5e-18.
  using Two = Eigen::Array2d;
  const Two z = Two::Constant(r * r);
  const auto term = [](std::size_t i) { return Eigen::Map<const Two>(kSeries[i].data()); };
  const auto from = [&](std::size_t i, const Two& higher) -> Two { return term(i) - z * higher; };
  const Two sum = from(0, from(1, from(2, from(3, from(4, from(5, from(6, from(7, term(8)))))))));
  const auto sine = std::bit_cast<std::uint64_t>(r * sum[0]), cosine = std::bit_cast<std::uint64_t>(sum[1]);

  // An odd quarter swaps the two; bit 1 of the quarter is the sign of the sine, and of the next that of the
  // cosine.
  const auto q = static_cast<std::uint64_t>(quarter);
  const std::uint64_t swap = (sine ^ cosine) & (0 - (q & 1));
  return {std::bit_cast<double>(sine ^ swap ^ ((q & 2) << 62)),
          std::bit_cast<double>(cosine ^ swap ^ (((q + 1) & 2) << 62))};
}

}  // namespace rex
