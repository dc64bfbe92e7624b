#pragma once

#include <span>

#include "estimation/gaussian.h"
#include "geometry/pose.h"

namespace rex {

/// Normalised estimation error squared, (mean - truth)^T covariance^-1 (mean - truth): chi-square with as
/// many degrees of freedom as entries if the filter is consistent. Differences of entries listed in
/// `angles` are wrapped. Throws Error for a covariance that is not definite. (NIS:
/// KalmanUpdate::squaredInnovation.)
[[nodiscard]] double estimationErrorSquared(const Gaussian& belief, const VectorArg& truth,
                                            std::span<const int> angles = {});

/// P(X <= x) of a chi-square variable. Throws Error unless degrees > 0.
[[nodiscard]] double chiSquareProbability(double x, double degrees);
/// The x with P(X <= x) = probability. Throws Error unless 0 < probability < 1.
[[nodiscard]] double chiSquareQuantile(double probability, double degrees);

/// Bounds between which the mean of `runs` independent chi-square variables lies with the given
/// probability.
struct ConsistencyBand {
  double lower = 0, upper = 0;
};
[[nodiscard]] ConsistencyBand consistencyBand(double runs, double degrees, double probability = 0.95);

/// Absolute trajectory error, metres: root mean square distance of the positions (d x T, d = 2 or 3) after
/// the rigid alignment of the estimate to the truth (Umeyama 1991). Throws Error for sizes that differ and
/// for no positions.
[[nodiscard]] double absoluteTrajectoryError(const MatrixArg& estimate, const MatrixArg& truth);

/// Root mean square errors of the motions over `steps` poses: metres and radians. Sturm et al. 2012.
struct RelativeError {
  double translation = 0, rotation = 0;
};
/// Relative pose error. Throws Error unless both have the same number of poses, more than `steps` > 0.
[[nodiscard]] RelativeError relativePoseError(std::span<const Pose> estimate, std::span<const Pose> truth,
                                              int steps = 1);
/// The same for planar poses (x, y, heading), one per column.
[[nodiscard]] RelativeError relativePoseError(const MatrixArg& estimate, const MatrixArg& truth,
                                              int steps = 1);

}  // namespace rex
