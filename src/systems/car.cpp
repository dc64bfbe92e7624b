#include "systems/car.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

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

// The angle a between car and trailer after `way` metres on an arc of curvature k: a' = k - sin(a) / d. Its
// w = exp(i a) satisfies a Riccati equation, w' = i k w + (1 - w^2) / (2 d), so that w = p / q with (p, q)' =
// N (p, q) of constant N, whose square is a multiple of the identity.
using Complex = std::complex<double>;
struct Fractions {
  Complex p, q, dp, dq;  // and their derivatives by the curvature
};

Fractions fractions(double hitchLength, double a, double curvature, double way) {
  const Complex w = std::polar(1., a), alpha(0, curvature / 2);
  const double beta = 1 / (2 * hitchLength);
  // exp(way N) = C + S N, for mu = way^2 N^2.
  const double mu = way * way * (beta * beta - curvature * curvature / 4);
  const double root = std::sqrt(std::abs(mu));
  const double C = mu > 0 ? std::cosh(root) : std::cos(root);
  const double S = std::abs(mu) < 1e-4 ? 1 + mu / 6 * (1 + mu / 20)
                   : mu > 0            ? std::sinh(root) / root
                                       : std::sin(root) / root;
  const double slope = std::abs(mu) < 1e-4 ? 1. / 6 + mu / 60 * (1 + mu / 28) : (C - S) / (2 * mu);
  const double dmu = -way * way * curvature / 2;
  const Complex Np = alpha * w + beta, Nq = beta * w - alpha, half(0, .5);
  return {C * w + S * way * Np, C + S * way * Nq, dmu * (S / 2 * w + slope * way * Np) + S * way * half * w,
          dmu * (S / 2 + slope * way * Nq) - S * way * half};
}

}  // namespace

double Car::turningRadius() const { return wheelbase / std::tan(maxSteering); }

Eigen::Vector3d carVelocity(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u) {
  requireControl(car, u);
  return {u[0] * std::cos(q[2]), u[0] * std::sin(q[2]), u[0] / car.wheelbase * std::tan(u[1])};
}

Eigen::Vector3d eulerStepCar(const Car& car, const Eigen::Vector3d& q, const Eigen::Vector2d& u, double tau) {
  const double way = tau * u[0];
  return {q[0] + way * std::cos(q[2]), q[1] + way * std::sin(q[2]),
          q[2] + way / car.wheelbase * std::tan(u[1])};
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

double Hitch::angle(double a, double curvature, double way) const {
  // In parts in which it turns by less than a radian, so that turns are counted.
  const int parts =
      1 + static_cast<int>(std::min(1e6, std::abs(way) * (std::abs(curvature) + 1 / hitchLength)));
  for (int i = 0; i < parts; ++i) {
    const Fractions at = fractions(hitchLength, a, curvature, way / parts);
    a += std::remainder(std::arg(at.p / at.q) - a, 2 * std::numbers::pi);
  }
  return a;
}

Eigen::Vector3d Hitch::slopes(double a, double curvature, double way) const {
  const Fractions at = fractions(hitchLength, a, curvature, way);
  const Complex w = at.p / at.q, byCurvature = (at.dp - w * at.dq) / at.q, start = std::polar(1., a);
  return {(start / (w * at.q * at.q)).real(), (byCurvature / (Complex(0, 1) * w)).real(),
          curvature - std::sin(std::arg(w)) / hitchLength};
}

Eigen::Vector4d driveTrailer(const CarWithTrailer& rig, const Eigen::Vector4d& q, const Eigen::Vector2d& u,
                             double seconds) {
  requirePositive("hitch of a trailer", rig.hitchLength, kMetres);
  Eigen::Vector4d end;
  end.head<3>() = driveCar(rig.car, q.head<3>(), u, seconds);
  const double curvature = std::tan(u[1]) / rig.car.wheelbase;
  end[3] = end[2] - Hitch{rig.hitchLength}.angle(q[2] - q[3], curvature, u[0] * seconds);
  return end;
}

}  // namespace rex
