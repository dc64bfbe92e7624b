#include "systems/cart_pole.h"

#include "base/lane_math.h"
#include "base/require.h"
#include "systems/normal_pair.h"

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
  const auto [s, c] = sinCos(x[2]);
  const double swing = c2() * x[3] * x[3] * s;
  const double turn = (g * s - c * (c1() * u + swing)) / (4 * l / 3 - c2() * c * c);
  return {x[1], c1() * u + swing - c2() * turn * c, x[3], turn};
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
  const Eigen::Vector4d rate = derivative(x, u);
  requirePositive("cart pole: time step tau", tau);
  return x + tau * rate;
}

Eigen::Vector4d CartPoleDynamics::noisyStep(const Eigen::Vector4d& x, double u, double tau, double noise,
                                            Rng& rng) const {
  requireNotNegative("cart pole: noise", noise);
  Eigen::Vector4d next = eulerStep(x, u, tau);
  const auto normals = internal::normalPair(rng);
  next[1] += noise * normals.first;
  next[3] += noise * normals.second;
  return next;
}

CartPole::CartPole(std::uint64_t seed, const CartPoleOptions& options) : options_(options), rng_(seed) {
  Rng draws = rng_;
  // A step whose result is discarded throws if an option is out of range.
  (void)options.dynamics.noisyStep(x, 0, options.tau, options.noise, draws);
}

}  // namespace rex
