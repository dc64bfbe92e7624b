#pragma once

namespace rex {

/// The integral of f from a to b, by Simpson's rule.
template <class F>
double integral(double a, double b, const F& f, int pieces = 20000) {
  double sum = f(a) + f(b);
  const double h = (b - a) / pieces;
  for (int k = 1; k < pieces; ++k) sum += (k % 2 == 1 ? 4 : 2) * f(a + k * h);
  return sum * h / 3;
}

}  // namespace rex
