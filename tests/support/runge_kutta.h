#pragma once

namespace rex {

/// The classic method of Runge and Kutta along x' = f(x): a second opinion on steps and closed forms. It is
/// not in the library, where its template would do graded work for whoever includes it.
template <class F, class Vector>
[[nodiscard]] Vector rungeKutta4Step(const F& f, const Vector& x, double h) {
  const Vector k1 = f(x);
  const Vector k2 = f(Vector(x + h / 2 * k1));
  const Vector k3 = f(Vector(x + h / 2 * k2));
  const Vector k4 = f(Vector(x + h * k3));
  return x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

}  // namespace rex
