#pragma once

#include <Eigen/Core>

#include "estimation/landmark_sensor.h"
#include "estimation/particle_filter.h"

namespace rex {

/// How a planar car moves from x = (x, y, heading) under u = (speed, steering angle) in a step: by Euler with
/// the heading before it (slide 4:48, errata 9), plus noise.
struct CarMotion {
  double tau = 1;                                ///< seconds
  double wheelbase = 2;                          ///< metres
  Eigen::Vector3d deviations{0.03, 0.03, 0.03};  ///< of the noise in x, y (metres) and heading
};

/// Draws from the motion, as motionProposal() would, but many particles side by side: for filters with very
/// many of them. Throws Error for a wheelbase that is not positive, negative deviations, and what is not
/// finite.
[[nodiscard]] Propose carProposal(const CarMotion& motion, const Eigen::Vector2d& u);

/// Adds log p(y | x) of sightings y (2 N numbers) of N known landmarks, up to a constant; particles of a
/// Cartesian sensor side by side. Throws Error for another size of y, a noise that is not definite, and what
/// is not finite; when called, for states that are not (x, y, heading), and as viewOf().
[[nodiscard]] Weigh landmarkWeights(const LandmarkSensor& sensor, const Eigen::Matrix2Xd& landmarks,
                                    const VectorArg& y);

}  // namespace rex
