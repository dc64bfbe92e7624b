#pragma once

#include <cmath>
#include <complex>
#include <string>

#include <fmt/format.h>

namespace rex::internal {

inline std::string eigenvalueText(std::complex<double> value) {
  return std::abs(value.imag()) < 1e-300 ? fmt::format("{:.6g}", value.real())
                                         : fmt::format("{:.6g}{:+.6g}i", value.real(), value.imag());
}

}  // namespace rex::internal
