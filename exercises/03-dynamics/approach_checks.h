#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "grading/check.h"
#include "interface.h"

// How a point of parts 1 and 3 comes to its goal: when, and in which regime.

inline constexpr double kTau = 0.01;

inline PointState moved(const PointState& at, double u, double mass) {
  return {at.q + kTau * at.v, at.v + kTau * u / mass};
}

// What is left of the way to a goal, 1 at first, step by step.
using Approach = std::vector<double>;

// How long until `left` is left, interpolated; the whole time if that never happens.
inline double timeUntil(const Approach& approach, double left) {
  for (std::size_t i = 1; i < approach.size(); ++i)
    if (approach[i] <= left)
      return kTau * (static_cast<double>(i) - (left - approach[i]) / (approach[i - 1] - approach[i]));
  return kTau * static_cast<double>(approach.size());
}

// The regime shows in overshoot and shape. Of two rates a and b, halving and coming within 5 % take times in
// the ratio 2.83 if they are equal, and 3.4 to 4.3 for xi > 1.25. Euler steps lower xi by tau / 2 lambda,
// below 0.1 here: a critical approach then overshoots by 0.15 % at most, at a ratio above 2.5.
inline void isInRegime(rex::grading::Check& check, const Approach& approach, Regime regime) {
  const double overshoot = -*std::min_element(approach.begin(), approach.end());
  if (regime == Regime::kOscillatory) {
    check.atLeast("overshoot, in ways", overshoot, 0.03);
    check.atMost("overshoot, in ways", overshoot, 0.6);
    int crossings = 0;
    for (std::size_t i = 1; i < approach.size(); ++i) crossings += approach[i] * approach[i - 1] < 0 ? 1 : 0;
    check.atLeast("how often it crosses its goal", crossings, 2);
    return;
  }
  const double ratio = timeUntil(approach, 0.05) / timeUntil(approach, 0.5);
  check.atMost("overshoot, in ways", overshoot, 2e-3);
  if (regime == Regime::kCritical) check.atMost("time for 95 % over time for half of the way", ratio, 3.1);
  if (regime == Regime::kOverdamped) check.atLeast("time for 95 % over time for half of the way", ratio, 3.3);
}

inline void arrivesInTime(rex::grading::Check& check, const Approach& approach, double T) {
  double lastAway = 0;
  for (std::size_t i = 0; i < approach.size(); ++i)
    if (std::abs(approach[i]) > 0.01) lastAway = kTau * static_cast<double>(i);
  check.atMost("last time at which it is more than 1 % away", lastAway, T, "s");
  check.atLeast("last time at which it is more than 1 % away", lastAway, T / 4, "s");
}
