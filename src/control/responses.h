#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

/// y over time.
struct TimeResponse {
  std::vector<double> times{};  ///< seconds
  Eigen::MatrixXd y{};          ///< p x number of times, one column per time
};

/// y from rest when u_input jumps to 1 at time 0 and stays: exact at `count` evenly spaced times from 0 to
/// T. A discrete system is evaluated at each of its steps, and `count` is ignored. Throws Error like
/// completed(), for an input that does not exist, a T that is not positive, and fewer than 2 or more than
/// 10^6 times.
[[nodiscard]] TimeResponse stepResponse(const LinearSystem& system, int input, double T, int count = 500);

/// The frequency response from one control to one measurement: G(i w) = C (i w - A)^-1 B + D; for a
/// discrete system with e^{i w step} instead of i w.
struct FrequencyResponse {
  std::vector<double> frequencies{};  ///< w, rad/s
  std::vector<std::complex<double>> values{};
  std::vector<double> magnitudes{};  ///< dB: 20 log10 |G|
  std::vector<double> phases{};      ///< degrees, unwrapped
};

/// The response at the given ascending frequencies, for Bode and Nyquist plots (render/figure_builders.h).
/// Throws Error like completed(), for an input or output that does not exist, frequencies that are not
/// positive, do not ascend, or lie above pi / step, and if G is infinite, naming the frequency.
[[nodiscard]] FrequencyResponse frequencyResponse(const LinearSystem& system, int input, int output,
                                                  const std::vector<double>& frequencies);

/// `count` logarithmically spaced frequencies from `low` to `high`. Throws Error unless 0 < low < high and
/// count is from 2 to 10^6.
[[nodiscard]] std::vector<double> frequenciesBetween(double low, double high, int count = 400);

}  // namespace rex
