#pragma once

#include "control/racer_constants_internal.h"
#include "control/racer_dynamics.h"
#include "control/racer_sensors.h"

namespace rex::internal {

/// Constants as kernels take them. Throw Error for those that are not positive, or not finite.
[[nodiscard]] RacerNumbers racerNumbers(const RacerDynamics& plant);
[[nodiscard]] RacerSensorNumbers racerSensorNumbers(const RacerSensors& sensors, double r);

}  // namespace rex::internal
