#include "optim/test_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"

namespace rex {
namespace {

using std::numbers::pi;

double square(double x) { return x * x; }

double sphere(const VectorArg& x) { return x.squaredNorm(); }

// Curvatures from 1 to 1e6.
double ellipsoid(const VectorArg& x) {
  const double last = std::max<double>(1, static_cast<double>(x.size() - 1));
  double sum = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    sum += std::pow(1e6, static_cast<double>(i) / last) * square(x[i]);
  return sum;
}

double cigar(const VectorArg& x) { return square(x[0]) + 1e6 * x.tail(x.size() - 1).squaredNorm(); }

double rosenbrock(const VectorArg& x) {
  double sum = 0;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i)
    sum += 100 * square(x[i + 1] - square(x[i])) + square(1 - x[i]);
  return sum;
}

double ackley(const VectorArg& x) {
  const auto n = static_cast<double>(x.size());
  double cosines = 0;
  for (const double xi : x) cosines += std::cos(2 * pi * xi);
  return 20 - 20 * std::exp(-0.2 * std::sqrt(x.squaredNorm() / n)) + std::numbers::e - std::exp(cosines / n);
}

double griewank(const VectorArg& x) {
  double product = 1;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    product *= std::cos(x[i] / std::sqrt(static_cast<double>(i + 1)));
  return x.squaredNorm() / 4000 - product + 1;
}

double rastrigin(const VectorArg& x) {
  double sum = 0;
  for (const double xi : x) sum += square(xi) + 10 * (1 - std::cos(2 * pi * xi));
  return sum;
}

// Turned by one radian in the plane of each coordinate and the next: no coordinate can be searched alone.
double rotatedRastrigin(const VectorArg& x) {
  const double c = std::cos(1), s = std::sin(1);
  Eigen::VectorXd turned = x;
  for (Eigen::Index i = 0; i + 1 < x.size(); ++i) {
    const double a = turned[i], b = turned[i + 1];
    turned[i] = c * a - s * b;
    turned[i + 1] = s * a + c * b;
  }
  return rastrigin(turned);
}

// The best coordinate, and what it contributes, to all digits: so the least value is 0.
constexpr double kSchwefelPlace = 420.968746359982, kSchwefelDepth = 418.98288727243374;

// With the penalty for leaving [-500, 500]^n in which the printed formula lacks a "- 500" (the paper's
// errata).
double schwefel(const VectorArg& x) {
  double sum = 0;
  for (const double xi : x) {
    sum += kSchwefelDepth - xi * std::sin(std::sqrt(std::abs(xi)));
    sum += 1e4 * square(std::max(0., std::abs(xi) - 500));
  }
  return sum;
}

constexpr std::array kFunctions = {TestFunction{"sphere", sphere, 0, 1, 5, 2, 1e-10},
                                   TestFunction{"ellipsoid", ellipsoid, 0, 1, 5, 2, 1e-10},
                                   TestFunction{"cigar", cigar, 0, 1, 5, 2, 1e-10},
                                   TestFunction{"rosenbrock", rosenbrock, 1, -2, 2, 1, 1e-10, 2},
                                   TestFunction{"ackley", ackley, 0, 1, 30, 14.5, 1e-3},
                                   TestFunction{"griewank", griewank, 0, 10, 600, 295, 1e-3},
                                   TestFunction{"rastrigin", rastrigin, 0, 1, 5, 2, 0.9},
                                   TestFunction{"rotated-rastrigin", rotatedRastrigin, 0, 1, 5, 2, 0.9, 2},
                                   TestFunction{"schwefel", schwefel, kSchwefelPlace, -500, 500, 500, 1e-3}};

}  // namespace

std::span<const TestFunction> testFunctions() { return kFunctions; }

const TestFunction& testFunction(std::string_view name) {
  std::vector<std::string> names;
  std::string all;
  for (const TestFunction& function : kFunctions) {
    if (function.name == name) return function;
    names.emplace_back(function.name);
    all += (all.empty() ? "" : ", ") + names.back();
  }
  throw Error({.what = "test function",
               .found = "'" + std::string(name) + "'",
               .wanted = all,
               .nearest = nearestNames(name, names)});
}

}  // namespace rex
