#pragma once

#include "planning/control_tree.h"
#include "planning/curve.h"
#include "systems/car.h"

namespace rex {

/// The controls (speed, steering angle) that drive a car along a curve at `speed` m/s, backward where the
/// curve goes backward. Throws Error for a curve that is tighter than the car can turn, and a speed that is
/// not positive.
[[nodiscard]] std::vector<HeldControl> controlsAlong(const Curve& curve, const Car& car, double speed = 1);

/// A car that drives at up to `speed` m/s, for trees of controls: steered along Dubins curves, and thus
/// forward only, or along those of Reeds and Shepp. Their lengths are the distances. Slide 4:61. `space`
/// holds (x, y, heading). Throws Error for a space of another size, and like controlsAlong.
[[nodiscard]] ControlSystem dubinsCar(const Space& space, const Car& car, double speed = 1);
[[nodiscard]] ControlSystem reedsSheppCar(const Space& space, const Car& car, double speed = 1);

}  // namespace rex
