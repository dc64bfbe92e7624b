#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "kinematics/trigonometric_roots_internal.h"

namespace rex::internal {
namespace {

// The cosine of k pi / 4.
double cosineOf(int k) {
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  constexpr std::array<double, 8> kCosines{1, kHalf, 0, -kHalf, -1, -kHalf, 0, kHalf};
  return kCosines[static_cast<std::size_t>(k % 8)];
}

double wrappedAngle(double x) {
  return x - 2 * std::numbers::pi * std::nearbyint(x / (2 * std::numbers::pi));
}

double valueOf(std::span<const double> a, double x) {
  double sum = 0;
  for (std::size_t i = a.size(); i-- > 0;) sum = sum * x + a[i];
  return sum;
}

// The root between two places with values of opposite signs, by Newton's steps inside the bracket.
double bracketedRoot(std::span<const double> a, double low, double high) {
  const bool isRising = valueOf(a, low) < 0;
  double x = 0.5 * (low + high);
  for (int i = 0; i < 200; ++i) {
    double value = 0, slope = 0;
    for (std::size_t k = a.size(); k-- > 0;) {
      slope = slope * x + value;
      value = value * x + a[k];
    }
    if (value == 0) return x;
    ((value < 0) == isRising ? low : high) = x;
    const double next = x - value / slope;
    const double last = x;
    x = next > low && next < high ? next : 0.5 * (low + high);
    if (std::abs(x - last) <= 2e-16 * std::abs(x) || x == low || x == high) return x;
  }
  return x;
}

// Between the places where the slope changes its sign, the graph is monotonous.
Angles rootsBetweenTurns(std::span<const double> a, double tolerance) {
  const std::size_t degree = a.size() - 1;
  Angles roots;
  if (degree == 0) return roots;
  if (a[degree] == 0) return rootsBetweenTurns(a.first(degree), tolerance);
  if (degree == 1) {
    roots.add(-a[0] / a[1]);
    return roots;
  }
  std::array<double, 4> slope{};
  for (std::size_t i = 1; i <= degree; ++i) slope[i - 1] = static_cast<double>(i) * a[i];
  const Angles turns = rootsBetweenTurns(std::span(slope).first(degree), 0);
  double bound = 0;
  for (std::size_t i = 0; i < degree; ++i) bound = std::max(bound, std::abs(a[i] / a[degree]));
  double low = -bound - 1;
  for (int k = 0; k <= turns.count; ++k) {
    const double high = k < turns.count ? turns.angle[static_cast<std::size_t>(k)] : bound + 1;
    const double below = valueOf(a, low), above = valueOf(a, high);
    const bool touchesLow = k > 0 && std::abs(below) <= tolerance;
    const bool touchesHigh = k < turns.count && std::abs(above) <= tolerance;
    if (touchesHigh)
      roots.add(high);
    else if (!touchesLow && (below < 0) != (above < 0))
      roots.add(bracketedRoot(a, low, high));
    low = high;
  }
  return roots;
}

}  // namespace

Angles rootsOfLine(double a, double b, double d, double least) {
  Angles result;
  const double size = std::hypot(a, b);
  if (size <= least) return result;
  constexpr double kRounding = 1e-12;
  const double cosine = d / size;
  if (std::abs(cosine) > 1 + kRounding) return result;
  const double middle = std::atan2(b, a), half = std::acos(std::clamp(cosine, -1., 1.));
  result.add(wrappedAngle(middle + half));
  if (half > 0 && half < std::numbers::pi) result.add(wrappedAngle(middle - half));
  return result;
}

Angles rootsOfSecondOrder(const std::array<double, 8>& values, double tolerance) {
  // As a polynomial in the tangent of half the angle from a place that is opposite to the largest value, so
  // that no root is infinite.
  const auto isSmaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto opposite = std::max_element(values.begin(), values.end(), isSmaller) - values.begin();
  const double largest = std::abs(values[static_cast<std::size_t>(opposite)]);
  if (!(largest > 0)) return {};
  double constant = 0, c1 = 0, s1 = 0, c2 = 0, s2 = 0;
  for (int k = 0; k < 8; ++k) {
    const double value = values[static_cast<std::size_t>((opposite + 4 + k) % 8)] / 8;
    constant += value;
    c1 += 2 * value * cosineOf(k);
    s1 += 2 * value * cosineOf(k + 6);
    c2 += 2 * value * cosineOf(2 * k);
    s2 += 2 * value * cosineOf(2 * k + 6);
  }
  const std::array<double, 5> a{constant + c1 + c2, 2 * s1 + 4 * s2, 2 * constant - 6 * c2, 2 * s1 - 4 * s2,
                                constant - c1 + c2};
  Angles result = rootsBetweenTurns(a, tolerance * largest);
  const double start = static_cast<double>((opposite + 4) % 8) * std::numbers::pi / 4;
  for (int k = 0; k < result.count; ++k) {
    double& one = result.angle[static_cast<std::size_t>(k)];
    one = wrappedAngle(start + 2 * std::atan(one));
  }
  return result;
}

}  // namespace rex::internal
