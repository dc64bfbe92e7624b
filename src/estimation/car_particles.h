#pragma once

#include <Eigen/Core>

#include "estimation/landmark_sensor.h"
#include "estimation/particle_filter.h"

namespace rex {

/// The motion model of a planar car with x = (x, y, heading) and u = (speed, steering angle): one Euler
/// step with the heading at its start (slide 4:48, errata 9), plus noise.
struct CarMotion {
  double tau = 1;                                ///< seconds
  double wheelbase = 2;                          ///< metres
  Eigen::Vector3d deviations{0.03, 0.03, 0.03};  ///< of the noise in x, y (m) and heading
};

/// Draws from the motion like motionProposal(), but vectorised, for filters with very many particles.
/// Throws Error for a wheelbase that is not positive, negative deviations, and numbers that are not finite.
[[nodiscard]] Propose carProposal(const CarMotion& motion, const Eigen::Vector2d& u);

/// Adds log p(y | x) of sightings y (size 2 N) of N known landmarks, up to a constant; vectorised for a
/// Cartesian sensor. Throws Error for a y of the wrong size, noise that is not definite, and numbers that
/// are not finite. When called, it throws Error for states that are not (x, y, heading), and like viewOf().
[[nodiscard]] Weigh landmarkWeights(const LandmarkSensor& sensor, const Eigen::Matrix2Xd& landmarks,
                                    const VectorArg& y);

}  // namespace rex
