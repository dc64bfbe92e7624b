#pragma once

#include <complex>
#include <string>
#include <vector>

#include "render/figure.h"

namespace rex {

/// Bode's plot, upper half: decibels over rad/s (logarithmic), with a line at 0 dB. The numbers are those of
/// frequencyResponse() (control/responses.h). Throws Error where their counts differ or there are none; so do
/// all below.
[[nodiscard]] Figure bodeMagnitudeFigure(const std::vector<double>& frequencies,
                                         const std::vector<double>& decibels);
/// Lower half: degrees over rad/s, with a line at -180 degrees, where feedback turns into its opposite.
[[nodiscard]] Figure bodePhaseFigure(const std::vector<double>& frequencies,
                                     const std::vector<double>& degrees);

/// Nyquist's plot: the response as a curve in the complex plane (dashed for negative frequencies), and the
/// point -1, around which it tells whether the closed loop is stable. What lies farther from zero than
/// `reach` is cut away. Throws Error for a reach that is not positive.
[[nodiscard]] Figure nyquistFigure(const std::vector<std::complex<double>>& values, double reach = 3);

/// Responses over time, a line for each row of `y`, with the labels given (none: y1, y2, ...).
[[nodiscard]] Figure stepFigure(const std::vector<double>& times, const Eigen::MatrixXd& y,
                                const std::vector<std::string>& labels = {});

}  // namespace rex
