#include "dynamics/ode_step.h"

#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace rex::ode_step_test {

// A damped oscillator, position and velocity: x'' = -4 x - 0.4 x'.
constexpr double kRate = 0.2;

template <class Vector>
Vector oscillator(const Vector& x) {
  Vector dx(2);
  dx << x[1], -4 * x[0] - 2 * kRate * x[1];
  return dx;
}

// Where it is after t seconds from (1, -kRate).
Eigen::Vector2d oscillation(double t) {
  const double w = std::sqrt(4 - kRate * kRate), decay = std::exp(-kRate * t);
  return {decay * std::cos(w * t), -decay * (kRate * std::cos(w * t) + w * std::sin(w * t))};
}

// The error after a second.
template <class Vector, class Step>
double oscillatorError(int steps, const Step& step) {
  Vector x = oscillation(0);
  for (int i = 0; i < steps; ++i) x = step(oscillator<Vector>, x, 1. / steps);
  return (x - oscillation(1)).norm();
}

const auto kEuler = [](const auto& f, const auto& x, double h) { return eulerStep(f, x, h); };
const auto kRungeKutta = [](const auto& f, const auto& x, double h) { return rungeKutta4Step(f, x, h); };

TEST(OdeStep, ErrorsShrinkWithTheirOrder) {
  EXPECT_NEAR(oscillatorError<Eigen::Vector2d>(200, kEuler) / oscillatorError<Eigen::Vector2d>(400, kEuler),
              2, 0.05);
  EXPECT_NEAR(
      oscillatorError<Eigen::Vector2d>(20, kRungeKutta) / oscillatorError<Eigen::Vector2d>(40, kRungeKutta),
      16, 1);
}

TEST(OdeStep, TakesVectorsOfAnySize) {
  EXPECT_EQ(oscillatorError<Eigen::VectorXd>(20, kRungeKutta),
            oscillatorError<Eigen::Vector2d>(20, kRungeKutta));
  EXPECT_EQ(oscillatorError<Eigen::VectorXd>(20, kEuler), oscillatorError<Eigen::Vector2d>(20, kEuler));
}

// Of x' = x, a step yields the first terms of the exponential series.
TEST(OdeStep, YieldsTheSeriesOfTheExponential) {
  const auto f = [](double x) { return x; };
  for (const double h : {0., 1e-8, 0.3, -0.7}) {
    EXPECT_DOUBLE_EQ(eulerStep(f, 2., h), 2 * (1 + h));
    EXPECT_NEAR(rungeKutta4Step(f, 2., h), 2 * (1 + h + h * h / 2 + h * h * h / 6 + h * h * h * h / 24),
                1e-15);
  }
}

}  // namespace rex::ode_step_test
