#pragma once

#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "render/figure.h"

namespace rex {

/// Counts samples in equal bins from the smallest to the largest, which belongs to the last bin. Throws
/// Error without samples, for a sample that is not finite, and for fewer than 1 or more than 10000 bins.
[[nodiscard]] Histogram sampleHistogram(const std::vector<double>& samples, int bins);

/// The same bars scaled to area one, for comparison with a density. Throws Error without edges or area.
[[nodiscard]] Histogram normalized(Histogram histogram);

/// f(x, y) at the centres of columns x rows cells. Throws Error for fewer than 2 or more than 2000 of either.
[[nodiscard]] HeatMap sampledHeatMap(const std::function<double(double x, double y)>& f, AxisRange xRange,
                                     AxisRange yRange, int columns = 100, int rows = 100);

/// The directions of the field f at columns x rows points; all arrows appear about equally long. There is
/// none where the field is zero. Throws Error for fewer than 1 or more than 200 columns or rows.
[[nodiscard]] Arrows arrowField(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& f,
                                AxisRange xRange, AxisRange yRange, int columns = 20, int rows = 16);

enum class TimeDomain { kContinuous, kDiscrete };

/// The complex plane with poles (crosses), zeros (circles) and the region of stability: the left
/// half-plane, or the unit disc for discrete time. You may change the title and everything else afterwards.
/// Throws Error if there are neither poles nor zeros, or if one of them is not finite.
[[nodiscard]] Figure poleFigure(const std::vector<std::complex<double>>& poles,
                                const std::vector<std::complex<double>>& zeros, TimeDomain domain);

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
