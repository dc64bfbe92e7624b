#pragma once

#include <cmath>

namespace rex {

/// A number that counts the products, quotients and roots taken of its kind.
struct Counted {
  double value = 0;
  inline static long count = 0;

  Counted() = default;
  explicit Counted(double v) : value(v) {}
  Counted& operator+=(Counted b) { return value += b.value, *this; }
  Counted& operator-=(Counted b) { return value -= b.value, *this; }
  friend Counted operator*(Counted a, Counted b) { return ++count, Counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++count, Counted(a.value / b.value); }
  friend bool operator>(Counted a, Counted b) { return a.value > b.value; }
};

inline Counted sqrt(Counted a) { return ++Counted::count, Counted(std::sqrt(a.value)); }

}  // namespace rex
