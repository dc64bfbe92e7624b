#pragma once

#include "control/cart_pole_dynamics.h"
#include "control/normal_pair_internal.h"

// The motion of a cart pole without checks, for loops.
namespace rex::internal {
namespace {

/// What the equations are made of.
struct CartPoleNumbers {
  double c1, c2, l, g;
};

inline CartPoleNumbers cartPoleNumbers(const CartPoleDynamics& plant) {
  return {plant.c1(), plant.c2(), plant.l, plant.g};
}

inline Eigen::Vector4d cartPoleDerivative(const CartPoleNumbers& k, const Eigen::Vector4d& x, double u) {
  const auto [s, c] = sinCos(x[2]);
  const double swing = k.c2 * x[3] * x[3] * s;
  const double turn = (k.g * s - c * (k.c1 * u + swing)) / (4 * k.l / 3 - k.c2 * c * c);
  return {x[1], k.c1 * u + swing - k.c2 * turn * c, x[3], turn};
}

inline Eigen::Vector4d withCartPoleNoise(Eigen::Vector4d x, double noise, Rng& rng) {
  const NormalPair<double> normals = normalPair(rng);
  x[1] += noise * normals.first;
  x[3] += noise * normals.second;
  return x;
}

}  // namespace
}  // namespace rex::internal
