#pragma once

#include <cmath>
#include <complex>
#include <string>

#include <fmt/format.h>

namespace rex::internal {

inline std::string eigenvalueText(std::complex<double> value) {
  const double real = value.real() + 0.;  // no -0
  return std::abs(value.imag()) < 1e-300 ? fmt::format("{:.6g}", real)
                                         : fmt::format("{:.6g}{:+.6g}i", real, value.imag());
}

}  // namespace rex::internal
