#include "control/cart_pole_dynamics.h"

#include "control/cart_pole_step_internal.h"
#include "control/require_internal.h"

namespace rex {
namespace {

void requireConstants(const CartPoleDynamics& plant) {
  requirePositive("cart pole: mass of the pole", plant.poleMass);
  requirePositive("cart pole: mass of the cart", plant.cartMass);
  requirePositive("cart pole: length l", plant.l);
  requirePositive("cart pole: gravity g", plant.g);
}

void requireArguments(const CartPoleDynamics& plant, const Eigen::Vector4d& x, double u) {
  requireConstants(plant);
  requireFinite("cart pole: state", x);
  requireFinite("cart pole: control u", u);
}

}  // namespace

Eigen::Vector4d CartPoleDynamics::derivative(const Eigen::Vector4d& x, double u) const {
  requireArguments(*this, x, u);
  return internal::cartPoleDerivative(internal::cartPoleNumbers(*this), x, u);
}

LinearizedPlant CartPoleDynamics::linearized(const Eigen::Vector4d& x, double u) const {
  requireArguments(*this, x, u);
  const auto [s, c] = sinCos(x[2]);
  const double w = x[3], turn = derivative(x, u)[3];
  const double D = 4 * l / 3 - c2() * c * c;
  const double byAngle =
      (g * c + c1() * u * s - c2() * w * w * (c * c - s * s) - turn * 2 * c2() * c * s) / D;
  const double byRate = -2 * c2() * w * s * c / D, byControl = -c1() * c / D;

  LinearizedPlant linear;
  linear.A(0, 1) = linear.A(2, 3) = 1;
  linear.A(1, 2) = c2() * (w * w * c - byAngle * c + turn * s);
  linear.A(1, 3) = c2() * (2 * w * s - byRate * c);
  linear.A(3, 2) = byAngle;
  linear.A(3, 3) = byRate;
  linear.B << 0, c1() - c2() * c * byControl, 0, byControl;
  return linear;
}

double CartPoleDynamics::energy(const Eigen::Vector4d& x) const {
  requireArguments(*this, x, 0);
  const double v = x[1], w = x[3], c = sinCos(x[2]).cosine;
  const double kinetic = (poleMass + cartMass) * v * v / 2 + poleMass * l * v * w * c +
                         poleMass * l * l * w * w * 2 / 3;  // a rod turns about its end with 4/3 m l^2
  return kinetic + poleMass * g * l * c;
}

Eigen::Vector4d CartPoleDynamics::eulerStep(const Eigen::Vector4d& x, double u, double tau) const {
  requireArguments(*this, x, u);
  requirePositive("cart pole: time step tau", tau);
  return x + tau * internal::cartPoleDerivative(internal::cartPoleNumbers(*this), x, u);
}

Eigen::Vector4d CartPoleDynamics::noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                            Rng& rng) const {
  requireNotNegative("cart pole: noise", noise);
  return internal::withCartPoleNoise(eulerStep(x, u, tau), noise, rng);
}

}  // namespace rex
