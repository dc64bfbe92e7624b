#include "systems/car.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "planning/car_curves.h"
#include "support/expect_error.h"

namespace rex::car_test {

// The second opinion: many small steps of the velocity by the midpoint rule.
template <class Velocity, class State>
State bySteps(const Velocity& velocity, State q, double seconds) {
  constexpr int kSteps = 20000;
  const double h = seconds / kSteps;
  for (int i = 0; i < kSteps; ++i) q += h * velocity(State(q + h / 2 * velocity(q)));
  return q;
}

TEST(Car, DrivesAsItsVelocitySays) {
  const Car car{.wheelbase = 2, .maxSteering = .6};
  Rng rng(1);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d q = rng.uniformVector(3, -3, 3);
    const Eigen::Vector2d u(rng.uniform(-2, 2), i < 2 ? i * 1e-7 : rng.uniform(-.6, .6));
    const Eigen::Vector3d end = driveCar(car, q, u, 3);
    const Eigen::Vector3d wanted =
        bySteps([&](const Eigen::Vector3d& at) { return carVelocity(car, at, u); }, q, 3);
    EXPECT_LT((end - wanted).norm(), 1e-6);
    EXPECT_NEAR(sidewaysSpeed(q, carVelocity(car, q, u)), 0, 1e-15);
    EXPECT_LT((driveCar(car, end, {-u[0], u[1]}, 3) - q).norm(), 1e-12) << "back the way it came";
    EXPECT_GE(std::abs(u[0]) * 3 + 1e-9, reedsSheppLength(q, end, car.turningRadius()));
  }
}

TEST(Car, PullsATrailerThatFollowsItsHitch) {
  const CarWithTrailer rig{.car = {.wheelbase = 2, .maxSteering = .6}, .hitchLength = 1.5};
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector4d q = rng.uniformVector(4, -1, 1);
    const Eigen::Vector2d u(rng.uniform(-2, 2), rng.uniform(-.6, .6));
    const Eigen::Vector4d end = driveTrailer(rig, q, u, 2);
    const Eigen::Vector4d wanted =
        bySteps([&](const Eigen::Vector4d& at) { return trailerVelocity(rig, at, u); }, q, 2);
    EXPECT_LT((end - wanted).norm(), 1e-6);
    EXPECT_LT((driveTrailer(rig, end, {-u[0], u[1]}, 2) - q).norm(), 1e-7);
    // The trailer's axle rolls: it does not slide sideways.
    const auto axle = [&](const Eigen::VectorXd& at) {
      return Eigen::VectorXd(at.head<2>() -
                             rig.hitchLength * Eigen::Vector2d(std::cos(at[3]), std::sin(at[3])));
    };
    const Eigen::VectorXd speed = numericJacobian(axle, q) * trailerVelocity(rig, q, u);
    EXPECT_NEAR(speed[0] * std::sin(q[3]) - speed[1] * std::cos(q[3]), 0, 1e-9);
  }
}

TEST(Car, RefusesWhatCannotBeDriven) {
  const Car car{.wheelbase = 1, .maxSteering = .5};
  const Eigen::Vector3d q(0, 0, 0);
  EXPECT_REX_ERROR(
      static_cast<void>(driveCar(car, q, {1, .6}, 1)),
      "control of a car: found speed 1, steering 0.6, wanted a finite speed, steering from -0.5 to 0.5");
  EXPECT_REX_ERROR(static_cast<void>(carVelocity(car, q, {NAN, 0})), "control of a car: found speed nan");
  EXPECT_REX_ERROR(static_cast<void>(carVelocity({.wheelbase = 0}, q, {1, 0})),
                   "wheelbase of a car: found 0 m, wanted a positive, finite number of metres");
  EXPECT_REX_ERROR(static_cast<void>(driveTrailer({.hitchLength = -1}, Eigen::Vector4d::Zero(), {1, 0}, 1)),
                   "hitch of a trailer: found -1 m, wanted a positive, finite number of metres");
}

}  // namespace rex::car_test
