#pragma once

#include <complex>
#include <string>
#include <vector>

#include "render/figure.h"

namespace rex {

/// The magnitude of a Bode plot: decibels over rad/s (logarithmic), with a line at 0 dB. The numbers are
/// those of frequencyResponse() (control/responses.h). Like all functions below, throws Error if their
/// counts differ or there are none.
[[nodiscard]] Figure bodeMagnitudeFigure(const std::vector<double>& frequencies,
                                         const std::vector<double>& decibels);
/// The phase of a Bode plot: degrees over rad/s, with a line at -180 degrees, where negative feedback
/// becomes positive.
[[nodiscard]] Figure bodePhaseFigure(const std::vector<double>& frequencies,
                                     const std::vector<double>& degrees);

/// The Nyquist plot: the response as a curve in the complex plane (dashed for negative frequencies), and
/// the point -1, whose encirclements show whether the closed loop is stable. The curve is cut off beyond a
/// distance of `reach` from zero. Throws Error for a reach that is not positive.
[[nodiscard]] Figure nyquistFigure(const std::vector<std::complex<double>>& values, double reach = 3);

/// Responses over time, a line for each row of `y`, with the given labels (default: y1, y2, ...).
[[nodiscard]] Figure stepFigure(const std::vector<double>& times, const Eigen::MatrixXd& y,
                                const std::vector<std::string>& labels = {});

}  // namespace rex
