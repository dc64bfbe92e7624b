#pragma once

namespace rex::internal {

/// What the racer's equations of motion are made of: M = [[inertiaX, coupling cos], [., inertiaTheta]] and
/// F = -coupling sin (theta'^2, g). The determinant of M is leastDeterminant + (coupling sin)^2, a sum of
/// what is not negative, where the difference of two products might lose it.
struct RacerNumbers {
  double inertiaX, inertiaTheta, coupling, gravity, perRadius, leastDeterminant;
};

/// What its sensors are made of.
struct RacerSensorNumbers {
  double scaledCosPhi, scaledSinPhi, kappaCosPhi, kappaSinPhi, gyroBias, perRadius;
};

}  // namespace rex::internal
