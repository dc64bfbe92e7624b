#pragma once

#include <cmath>

#include "exercise.h"

// Given: how the compass walker swings between two impacts.

/// The rate of the state x = (theta_s, theta_ns, and their rates): M q'' = h with h = -C q' - G (11:20),
/// solved for q''. Deriving it (3:20, 3:21) is a question for the tutorial.
inline Eigen::Vector4d swingRate(const Walker& walker, const Eigen::Vector4d& x) {
  const double l = walker.a + walker.b, m = walker.legMass;
  const double coupling = m * l * walker.b, gap = x[0] - x[1];
  const double m11 = (walker.hipMass + m) * l * l + m * walker.a * walker.a;
  const double m12 = -coupling * std::cos(gap), m22 = m * walker.b * walker.b;
  const double lift = walker.g * ((walker.hipMass + m) * l + m * walker.a);
  const double h1 = coupling * std::sin(gap) * x[3] * x[3] + lift * std::sin(x[0]);
  const double h2 = -coupling * std::sin(gap) * x[2] * x[2] - m * walker.g * walker.b * std::sin(x[1]);
  const double determinant = m11 * m22 - m12 * m12;
  return {x[2], x[3], (m22 * h1 - m12 * h2) / determinant, (m11 * h2 - m12 * h1) / determinant};
}
