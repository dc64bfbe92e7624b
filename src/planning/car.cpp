#include "planning/car.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

void requireControl(const Car& car, const Eigen::Vector2d& u) {
  requirePositive("wheelbase of a car", car.wheelbase, kMetres);
  if (std::isfinite(u[0]) && std::abs(u[1]) <= car.maxSteering) return;
  throw Error({.what = "control of a car",
               .found = fmt::format("speed {:g}, steering {:g}", u[0], u[1]),
               .wanted = fmt::format("a finite speed, steering from {:g} to {:g}", -car.maxSteering,
                                     car.maxSteering)});
}

}  // namespace

double Car::turningRadius() const { return wheelbase / std::tan(maxSteering); }

Eigen::Vector3d carVelocity(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u) {
  requireControl(car, u);
  return {u[0] * std::cos(q[2]), u[0] * std::sin(q[2]), u[0] / car.wheelbase * std::tan(u[1])};
}

Eigen::Vector3d driveCar(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u, double seconds) {
  requireControl(car, u);
  const double way = u[0] * seconds, half = way * std::tan(u[1]) / car.wheelbase / 2;
  // The chord of the arc, which points in the mean direction; for a small turn, by its series.
  const double chord = std::abs(half) < 1e-4 ? way * (1 - half * half / 6) : way * std::sin(half) / half;
  return {q[0] + chord * std::cos(q[2] + half), q[1] + chord * std::sin(q[2] + half), q[2] + 2 * half};
}

double sidewaysSpeed(const Eigen::Vector3d& q, const Eigen::Vector3d& velocity) {
  return velocity[0] * std::sin(q[2]) - velocity[1] * std::cos(q[2]);
}

Eigen::Vector4d trailerVelocity(const CarWithTrailer& rig, const Eigen::Vector4d& q,
                                const Eigen::Vector2d& u) {
  requirePositive("hitch of a trailer", rig.hitchLength, kMetres);
  Eigen::Vector4d velocity;
  velocity << carVelocity(rig.car, q.head<3>(), u), u[0] / rig.hitchLength * std::sin(q[2] - q[3]);
  return velocity;
}

Eigen::Vector4d driveTrailer(const CarWithTrailer& rig, const Eigen::Vector4d& q, const Eigen::Vector2d& u,
                             double seconds) {
  requirePositive("hitch of a trailer", rig.hitchLength, kMetres);
  // Steps that turn neither by more than a hundredth of a radian.
  const double turns =
      std::abs(u[0] * seconds) * (1 / rig.hitchLength + std::tan(std::abs(u[1])) / rig.car.wheelbase);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::min(1e6, 100 * turns))));
  const double h = seconds / steps;
  double trailer = q[3];
  for (int i = 0; i < steps; ++i) {
    const auto turn = [&](double share, double heading) {
      return u[0] / rig.hitchLength *
             std::sin(driveCar(rig.car, q.head<3>(), u, (i + share) * h)[2] - heading);
    };
    const double k1 = turn(0, trailer), k2 = turn(.5, trailer + h / 2 * k1),
                 k3 = turn(.5, trailer + h / 2 * k2), k4 = turn(1, trailer + h * k3);
    trailer += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  Eigen::Vector4d end;
  end << driveCar(rig.car, q.head<3>(), u, seconds), trailer;
  return end;
}

}  // namespace rex
