#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "render/figure.h"

namespace rex {

/// Counts samples in equal bins from the smallest to the largest, which belongs to the last bin. Throws
/// Error without samples, for a sample that is not finite, and for fewer than 1 or more than 10000 bins.
[[nodiscard]] Histogram histogramOf(const std::vector<double>& samples, int bins);

/// The same bars scaled to area one, for comparison with a density. Throws Error without edges or area.
[[nodiscard]] Histogram normalized(Histogram histogram);

/// f(x, y) at the centres of columns x rows cells. Throws Error for fewer than 2 or more than 2000 of either.
[[nodiscard]] HeatMap heatMapOf(const std::function<double(double x, double y)>& f, AxisRange xRange,
                                AxisRange yRange, int columns = 100, int rows = 100);

/// The directions of the field f at columns x rows points; all arrows appear about equally long. There is
/// none where the field is zero. Throws Error for fewer than 1 or more than 200 columns or rows.
[[nodiscard]] Arrows arrowsOf(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& f,
                              AxisRange xRange, AxisRange yRange, int columns = 20, int rows = 16);

enum class TimeDomain { kContinuous, kDiscrete };

/// The complex plane with poles (crosses), zeros (circles) and the region of stability: the left
/// half-plane, or the unit disc for discrete time. You may change the title and everything else afterwards.
/// Throws Error if there are neither poles nor zeros, or if one of them is not finite.
[[nodiscard]] Figure poleFigure(const std::vector<std::complex<double>>& poles,
                                const std::vector<std::complex<double>>& zeros, TimeDomain domain);

}  // namespace rex
