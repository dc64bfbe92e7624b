#pragma once

#include <span>

#include "estimation/gaussian.h"
#include "geometry/pose.h"

namespace rex {

/// Normalised estimation error squared, (mean - truth)^T covariance^-1 (mean - truth): chi-square of as many
/// degrees as numbers when the filter is consistent. Numbers marked as angles are compared the shorter way
/// round. Throws Error for a covariance that is not definite. (NIS: KalmanUpdate::squaredInnovation.)
[[nodiscard]] double estimationErrorSquared(const Gaussian& belief, const VectorArg& truth,
                                            std::span<const int> angles = {});

/// P(X <= x) of a chi-square variable. Throws Error unless degrees > 0.
[[nodiscard]] double chiSquareProbability(double x, double degrees);
/// The x with P(X <= x) = probability. Throws Error unless that lies within 0 and 1, without these.
[[nodiscard]] double chiSquareQuantile(double probability, double degrees);

/// Between which bounds the mean of `runs` independent chi-square numbers lies with that probability.
struct ConsistencyBand {
  double lower = 0, upper = 0;
};
[[nodiscard]] ConsistencyBand consistencyBand(double runs, double degrees, double probability = 0.95);

/// Absolute trajectory error: root mean square distance of the positions (d x T, d = 2 or 3) after the rigid
/// motion that brings the estimate nearest to the truth (Umeyama 1991), metres. Throws Error for sizes that
/// differ or less than one position.
[[nodiscard]] double absoluteTrajectoryError(const MatrixArg& estimate, const MatrixArg& truth);

/// Root mean square errors of the motions over `steps` poses: metres and radians. Sturm et al. 2012.
struct RelativeError {
  double translation = 0, rotation = 0;
};
/// Relative pose error. Throws Error unless there are as many poses in both, and more than `steps` > 0.
[[nodiscard]] RelativeError relativePoseError(std::span<const Pose> estimate, std::span<const Pose> truth,
                                              int steps = 1);
/// The same of planar poses (x, y, heading), one per column.
[[nodiscard]] RelativeError relativePoseError(const MatrixArg& estimate, const MatrixArg& truth,
                                              int steps = 1);

}  // namespace rex
