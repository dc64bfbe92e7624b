#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

namespace rex::internal {

/// A step and how far its last two orders lie apart (largest entry).
template <class Vector>
struct ExtrapolatedStep {
  Vector x;
  double error;
};

/// One step of length h along x' = f(x), of order 12: Gragg's midpoint rule with 2, 4, ... 12 parts,
/// extrapolated to infinitely many (Bulirsch, Stoer 1966). A smooth function of h.
template <class Vector, class F>
ExtrapolatedStep<Vector> extrapolatedStep(const F& f, const Vector& x, double h) {
  constexpr int kColumns = 6;
  const Vector slope = f(x);
  std::array<Vector, kColumns> column;  // of the tableau's last row
  ExtrapolatedStep<Vector> step{x, 0};
  for (int k = 0; k < kColumns; ++k) {
    const int parts = 2 * (k + 1);
    const double part = h / parts;
    Vector before = x, at = x + part * slope;
    for (int i = 1; i < parts; ++i) {
      const Vector next = before + 2 * part * f(at);
      before = at;
      at = next;
    }
    Vector value = at;
    for (int j = 0; j < k; ++j) {
      const double ratio = static_cast<double>(k + 1) / (k - j);
      const Vector former = column[static_cast<std::size_t>(j)];
      column[static_cast<std::size_t>(j)] = value;
      const Vector change = (value - former) / (ratio * ratio - 1);
      if (j + 1 == kColumns - 1) step.error = change.cwiseAbs().maxCoeff();
      value += change;
    }
    column[static_cast<std::size_t>(k)] = value;
  }
  step.x = column.back();
  return step;
}

/// Happens where `value` goes from above zero to zero or below, if `applies` there (empty: always).
template <class Vector>
struct Event {
  std::function<double(const Vector&)> value;
  std::function<bool(const Vector&)> applies{};
};

/// Where an integration ended: at events[*event], or at the end of its time.
template <class Vector>
struct EventPoint {
  double t = 0;
  Vector x;
  std::optional<int> event{};
};

/// The length in (0, h] at which `value` along the step from x falls to zero, to the last bit but a few:
/// false position that halves the weight of an end that stays (Illinois), each trial a step of its own.
template <class Vector, class F>
double eventLength(const F& f, const Vector& x, double h, const Event<Vector>& event) {
  double low = 0, high = h;
  double above = event.value(x), below = event.value(extrapolatedStep(f, x, h).x);
  for (int i = 0, stays = 0; i < 100 && below != 0 && high - low > 4e-16 * high; ++i) {
    const double guess = (low * below - high * above) / (below - above);
    const double at = guess > low && guess < high ? guess : low + (high - low) / 2;
    if (at <= low || at >= high) break;
    const double value = event.value(extrapolatedStep(f, x, at).x);
    if (value > 0) {
      low = at;
      above = value;
      if (stays > 0) below /= 2;
      stays = std::max(stays, 0) + 1;
    } else {
      high = at;
      below = value;
      if (stays < 0) above /= 2;
      stays = std::min(stays, 0) - 1;
    }
  }
  return high;
}

/// Follows x' = f(x) from x to the first event, or for the time `end`, by steps of at most `longest` that
/// keep the last two orders within 1e-13. What rises and falls again within one step is not seen.
template <class Vector, class F>
EventPoint<Vector> integrateToEvent(const F& f, const Vector& x, double end, double longest,
                                    std::span<const Event<Vector>> events) {
  EventPoint<Vector> at{.t = 0, .x = x};
  double h = longest;
  const double shortest = 1e-6 * longest;
  while (at.t < end) {
    h = std::min(h, end - at.t);
    const ExtrapolatedStep<Vector> step = extrapolatedStep(f, at.x, h);
    const double allowed = 1e-13 * std::max(1., at.x.cwiseAbs().maxCoeff());
    if (!(step.error <= allowed) && h > shortest) {
      h /= 2;
      continue;
    }
    double first = h;
    for (std::size_t i = 0; i < events.size(); ++i) {
      const bool falls = events[i].value(at.x) > 0 && !(events[i].value(step.x) > 0);
      if (!falls || (events[i].applies && !events[i].applies(step.x))) continue;
      const double length = eventLength(f, at.x, h, events[i]);
      if (at.event && length >= first) continue;
      first = length;
      at.event = static_cast<int>(i);
    }
    at.x = at.event ? extrapolatedStep(f, at.x, first).x : step.x;
    at.t += first;
    if (at.event) return at;
    h = std::min(longest, 2 * h);
  }
  return at;
}

}  // namespace rex::internal
