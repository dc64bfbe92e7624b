#pragma once

namespace rex {

// Steps of length h along x' = f(x), for x of any type that adds and scales: a double, an Eigen vector. What
// f depends on besides, such as a control, is held: let a lambda capture it.

/// Explicit Euler, first order: x + h f(x).
template <class F, class Vector>
[[nodiscard]] Vector eulerStep(const F& f, const Vector& x, double h) {
  return x + h * f(x);
}

/// The classic method of Runge and Kutta, fourth order.
template <class F, class Vector>
[[nodiscard]] Vector rungeKutta4Step(const F& f, const Vector& x, double h) {
  const Vector k1 = f(x);
  const Vector k2 = f(Vector(x + h / 2 * k1));
  const Vector k3 = f(Vector(x + h / 2 * k2));
  const Vector k4 = f(Vector(x + h * k3));
  return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

}  // namespace rex
