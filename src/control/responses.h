#pragma once

#include <complex>
#include <vector>

#include <Eigen/Core>

#include "control/linear_system.h"

namespace rex {

/// y over time, one column per time.
struct TimeResponse {
  std::vector<double> times{};  ///< seconds
  Eigen::MatrixXd y{};          ///< p x times
};

/// y from rest when u_input jumps to 1 at time 0 and stays: exact at `count` equal times from 0 to T; a
/// discrete system at each of its steps, and `count` is not used. Throws Error as completed(), for an input
/// that is not there, a T that is not positive, fewer than 2 or more than 10^6 times.
[[nodiscard]] TimeResponse stepResponse(const LinearSystem& system, int input, double T, int count = 500);

/// The response to sines: G(i w) = C (i w - A)^-1 B + D, or with e^{i w step} for i w, from one control to
/// one measurement.
struct FrequencyResponse {
  std::vector<double> frequencies{};  ///< w, rad/s
  std::vector<std::complex<double>> values{};
  std::vector<double> magnitudes{};  ///< dB: 20 log10 |G|
  std::vector<double> phases{};      ///< degrees, without jumps of 360
};

/// At the given frequencies, which ascend, for Bode's and Nyquist's figures (render/response_figures.h).
/// Throws Error as completed(), for an input or output that is not there, frequencies that are not positive,
/// do not ascend, or lie above pi / step, and where G is infinite, naming the frequency.
[[nodiscard]] FrequencyResponse frequencyResponse(const LinearSystem& system, int input, int output,
                                                  const std::vector<double>& frequencies);

/// `count` frequencies from `low` to `high`, each larger than the one before by the same factor. Throws Error
/// unless 0 < low < high and count is 2 to 10^6.
[[nodiscard]] std::vector<double> frequenciesBetween(double low, double high, int count = 400);

}  // namespace rex
