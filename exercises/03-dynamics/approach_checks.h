#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "grading/check.h"
#include "interface.h"

// How a point of parts 1 and 3 approaches its goal: when it arrives, and in which regime.

inline constexpr double kTau = 0.01;

inline PointState moved(const PointState& at, double u, double mass) {
  return {at.q + kTau * at.v, at.v + kTau * u / mass};
}

// The remaining share of the way to a goal at each step; 1 at first.
using Approach = std::vector<double>;

// The time until the share `left` remains, interpolated; the whole duration if that never happens.
inline double timeUntil(const Approach& approach, double left) {
  for (std::size_t i = 1; i < approach.size(); ++i)
    if (approach[i] <= left)
      return kTau * (static_cast<double>(i) - (left - approach[i]) / (approach[i - 1] - approach[i]));
  return kTau * static_cast<double>(approach.size());
}

// The regime shows in the overshoot and in the shape. The times to come within 5 % and to cover half of the
// way have the ratio 2.83 if both decay rates are equal, and 3.4 to 4.3 for xi > 1.25. Euler steps lower xi
// by tau / 2 lambda, below 0.1 here: a critical approach then overshoots by at most 0.15 %, at a ratio
// above 2.5.
inline void isInRegime(rex::grading::Check& check, const std::string& function, const Approach& approach,
                       Regime regime) {
  const double overshoot = -*std::min_element(approach.begin(), approach.end());
  const std::string share = "overshoot under " + function + ", as a share of the way";
  if (regime == Regime::kOscillatory) {
    check.atLeast(share, overshoot, 0.03);
    check.atMost(share, overshoot, 0.6);
    int crossings = 0;
    for (std::size_t i = 1; i < approach.size(); ++i) crossings += approach[i] * approach[i - 1] < 0 ? 1 : 0;
    check.atLeast("number of times that the point crosses its goal under " + function, crossings, 2);
    return;
  }
  const std::string times = "time for 95 % of the way / time for half of it, under " + function;
  const double ratio = timeUntil(approach, 0.05) / timeUntil(approach, 0.5);
  check.atMost(share, overshoot, 2e-3);
  if (regime == Regime::kCritical) check.atMost(times, ratio, 3.1);
  if (regime == Regime::kOverdamped) check.atLeast(times, ratio, 3.3);
}

inline void arrivesInTime(rex::grading::Check& check, const std::string& function, const Approach& approach,
                          double T) {
  double lastAway = 0;
  for (std::size_t i = 0; i < approach.size(); ++i)
    if (std::abs(approach[i]) > 0.01) lastAway = kTau * static_cast<double>(i);
  check.atMost("last time at which the point is more than 1 % away, under " + function, lastAway, T, "s");
  check.atLeast("last time at which the point is more than 1 % away, under " + function, lastAway, T / 4,
                "s");
}
