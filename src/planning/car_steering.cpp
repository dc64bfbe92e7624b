#include "planning/car_steering.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "planning/dubins.h"
#include "planning/reeds_shepp.h"

namespace rex {
namespace {

constexpr Unit kSpeedUnit{"m/s", "metres per second"};

using CurveBetween = Curve (*)(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);
using LengthBetween = double (*)(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius);

ControlSystem steeredCar(const Space& space, const Car& car, double slowest, double speed, CurveBetween curve,
                         LengthBetween length) {
  requireSize("space of a car", space.size(), 3);
  requirePositive("speed of a car", speed, kSpeedUnit);
  requirePositive("wheelbase of a car", car.wheelbase, kMetres);
  const double radius = car.turningRadius();
  requirePositive("turning radius", radius, kMetres);
  return {.space = space,
          .lower = Eigen::Vector2d(slowest, -car.maxSteering),
          .upper = Eigen::Vector2d(speed, car.maxSteering),
          .motion = [car](const VectorArg& x, const VectorArg& u, double seconds) -> Eigen::VectorXd {
            return driveCar(car, x, u, seconds);
          },
          .distance = [=](const VectorArg& from, const VectorArg& to) { return length(from, to, radius); },
          .steer = [=](const VectorArg& from,
                       const VectorArg& to) { return controlsAlong(curve(from, to, radius), car, speed); }};
}

}  // namespace

std::vector<HeldControl> controlsAlong(const Curve& curve, const Car& car, double speed) {
  requirePositive("speed of a car", speed, kSpeedUnit);
  // Rounding alone may ask for a little more than the largest angle.
  const double steering = std::min(car.maxSteering, std::atan(car.wheelbase / curve.radius()));
  if (curve.radius() < (1 - 1e-9) * car.turningRadius())
    throw Error(
        {.what = "radius of a curve",
         .found = fmt::format("{:g} m", curve.radius()),
         .wanted = fmt::format("at least the turning radius of the car, {:g} m", car.turningRadius())});
  std::vector<HeldControl> controls;
  for (const CurveSegment& segment : curve.segments()) {
    const double side = segment.steering == Steering::kLeft    ? steering
                        : segment.steering == Steering::kRight ? -steering
                                                               : 0;
    controls.push_back(
        {Eigen::Vector2d(segment.length < 0 ? -speed : speed, side), std::abs(segment.length) / speed});
  }
  return controls;
}

ControlSystem dubinsCar(const Space& space, const Car& car, double speed) {
  return steeredCar(space, car, 0, speed, dubinsCurve, dubinsLength);
}

ControlSystem reedsSheppCar(const Space& space, const Car& car, double speed) {
  return steeredCar(space, car, -speed, speed, reedsSheppCurve, reedsSheppLength);
}

}  // namespace rex
