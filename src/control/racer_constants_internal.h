#pragma once

namespace rex::internal {

/// What the racer's equations of motion are made of: M = [[inertiaX, coupling cos], [., inertiaTheta]] and
/// F = -coupling sin (theta'^2, g).
struct RacerNumbers {
  double inertiaX, inertiaTheta, coupling, gravity, perRadius;
};

/// What its sensors are made of.
struct RacerSensorNumbers {
  double scaledCosPhi, scaledSinPhi, kappaCosPhi, kappaSinPhi, gyroBias, perRadius;
};

}  // namespace rex::internal
