#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "arm_checks.h"
#include "grading/check.h"
#include "interface.h"

// Part 2: which gains of a PID controller bring a point to rest.

// The greatest real part of the roots of m s^3 + Kd s^2 + Kp s + Ki, or of m s^2 + Kd s + Kp if Ki is zero.
inline double growth(const PidSettings& gains, double mass) {
  const int order = gains.Ki == 0 ? 2 : 3;
  const Eigen::Vector3d coefficients = -Eigen::Vector3d(gains.Kd, gains.Kp, gains.Ki) / mass;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(order, order);
  companion.row(0) = coefficients.head(order).transpose();
  companion.bottomLeftCorner(order - 1, order - 1).setIdentity();
  return rex::eigenvalues(companion).real().maxCoeff();
}

struct KnownLoop {
  PidSettings gains{};
  double mass = 3.456;
  bool isStable = false;
};

// Shuffled, so that counting calls does not help. Random gains whose roots are too close to the imaginary
// axis are left out; the cases on the axis are exact.
inline void judgesPid(rex::grading::Check& check, Student& student) {
  std::vector<KnownLoop> loops{{.gains = {0, 2, 0}},  // Ki alone
                               {.gains = {0, 2, 3}},  // Ki and Kd
                               {.gains = {5, 0, 0}},  // oscillates for ever
                               {.gains = {0, 0, 5}},  // comes to rest anywhere
                               {.gains = {5, 0, 3}, .isStable = true},
                               {.gains = {4, 6, 3}, .mass = 2},  // on the border
                               {.gains = {-4, 1, -3}, .mass = 2}};
  rex::Rng& rng = check.rng();
  const auto power = [&] { return std::exp2(rng.index(5) - 2); };
  for (int i = 0; i < 16; ++i) {  // on the border: Kp Kd = m Ki, exact in every order of multiplications
    const double a = power(), b = power(), c = 1 + rng.index(5), d = 1 + rng.index(5);
    loops.push_back({.gains = {a * c, c * d, b * d}, .mass = a * b});
  }
  while (loops.size() < 83) {
    const PidSettings gains{rng.uniform(-3, 10), rng.index(3) == 0 ? 0 : rng.uniform(-3, 10),
                            rng.uniform(-3, 10)};
    const double mass = rng.uniform(0.5, 5), rate = growth(gains, mass);
    // Half of the cases are stable, half are not.
    if (std::abs(rate) < 1e-3 || (rate < 0) != (loops.size() % 2 == 0)) continue;
    loops.push_back({gains, mass, rate < 0});
  }
  for (std::size_t k = loops.size(); k > 0; --k) {
    std::swap(loops[k - 1], loops[static_cast<std::size_t>(rng.index(static_cast<int>(k)))]);
    const auto& [gains, mass, isStable] = loops[k - 1];
    check.input(isStable ? "a point that comes to rest" : "a point that does not come to rest",
                {{"Kp", gains.Kp}, {"Ki", gains.Ki}, {"Kd", gains.Kd}, {"mass", mass}});
    const bool got = student.isStable(gains, mass);
    const auto& [Kp, Ki, Kd] = gains;
    const bool positive = Kp > 0 && Kd > 0 && Ki > 0;
    const auto noIntegral =
        check.ask("Ki = 0 is PD control. Which condition is left then?", isStable && Ki == 0);
    const auto border =
        check.ask("Does an oscillation that neither grows nor dies count as rest, by rounding or by >=?",
                  !isStable && positive && Kp * Kd == mass * Ki);
    const auto noMass =
        check.ask("Is the mass left out?", positive && isStable != got && got == (Kp * Kd > Ki) && mass != 1);
    const auto enough =
        check.ask("Is it enough that no gain is negative? A large Ki is too much.", !isStable && positive);
    check.that(isStable ? "isStable returns true" : "isStable returns false", got == isStable);
  }
}
