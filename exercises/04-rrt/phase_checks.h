#pragma once

#include <cmath>
#include <vector>

#include "exercise.h"
#include "grading/check.h"
#include "interface.h"

// What motions with the least effort must satisfy.

/// Integral by Simpson's rule, exact for cubics, with f at 21 times from 0 to T.
template <class F>
double integral(double T, const F& f) {
  const int n = 20;
  double sum = 0;
  for (int i = 0; i <= n; ++i) sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * f(i);
  return sum * T / (3 * n);
}

struct Transfer {
  Eigen::Vector2d from, to;
  double T;
};

inline Transfer randomTransfer(rex::Rng& rng) {
  return {rng.uniformVector(2, -3, 3), rng.uniformVector(2, -3, 3), rng.uniform(0.5, 4)};
}

/// The force must bring the point there, with the least effort. Pushes at three consecutive times in
/// proportion to 1, -2 and 1 change neither the final velocity nor the final position, so that none of them
/// may change the effort to first order. All changes of the force that keep the final state are sums of
/// these.
inline void leastEffortIsRight(rex::grading::Check& check, Student& student, const Transfer& x) {
  const double T = x.T;
  std::vector<double> u;
  for (int i = 0; i <= 20; ++i) u.push_back(student.forceAt(x.from, x.to, T, T * i / 20));
  const auto at = [&](int i) { return u[static_cast<std::size_t>(i)]; };
  // From the wanted force at both ends; in between it is a straight line.
  const double way = x.to[0] - x.from[0];
  const double scale = 1 + std::abs(6 * way - 2 * T * (2 * x.from[1] + x.to[1])) / (T * T) +
                       std::abs(6 * way - 2 * T * (x.from[1] + 2 * x.to[1])) / (T * T);
  check.near("final velocity under that force", x.from[1] + integral(T, at), x.to[1], 1e-8 * scale, "m/s");
  check.near("final position under that force",
             x.from[0] + T * x.from[1] + integral(T, [&](int i) { return T * (1 - i / 20.) * at(i); }),
             x.to[0], 1e-8 * scale * T, "m");
  const double needed = integral(T, [&](int i) { return at(i) * at(i); });
  check.near("effort against the integral of the squared force", student.effort(x.from, x.to, T), needed,
             1e-8 * scale * scale * T, "N^2 s");
  for (int i = 1; i < 20; ++i)
    check.near("change of the effort by pushes that keep the final state", at(i - 1) - 2 * at(i) + at(i + 1),
               0, 4e-8 * scale, "N");
}
