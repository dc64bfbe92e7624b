#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "render/figure.h"

namespace rex {

/// Counts samples in equal bins from the least to the greatest, which belongs to the last bin. Throws Error
/// without samples, for a sample that is not finite, and for less than 1 or more than 10000 bins.
[[nodiscard]] Histogram histogramOf(const std::vector<double>& samples, int bins);

/// The same bars with area one, to compare with a density. Throws Error without edges or area.
[[nodiscard]] Histogram normalized(Histogram histogram);

/// f(x, y) at the centres of columns x rows cells. Throws Error for fewer than 2 or more than 2000 each way.
[[nodiscard]] HeatMap heatMapOf(const std::function<double(double x, double y)>& f, AxisRange xRange,
                                AxisRange yRange, int columns = 100, int rows = 100);

/// The directions of the field f on columns x rows points; on paper all arrows are about equally long. None
/// where the field is zero. Throws Error for less than 1 or more than 200 each way.
[[nodiscard]] Arrows arrowsOf(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& f,
                              AxisRange xRange, AxisRange yRange, int columns = 20, int rows = 16);

enum class TimeDomain { kContinuous, kDiscrete };

/// The complex plane with poles (crosses), zeros (circles) and the region of stability: the left half, or the
/// unit disc for discrete time. Title and all else may be changed afterwards. Throws Error without poles and
/// zeros, or when one of them is not finite.
[[nodiscard]] Figure poleFigure(const std::vector<std::complex<double>>& poles,
                                const std::vector<std::complex<double>>& zeros, TimeDomain domain);

}  // namespace rex
