#include "control/linear_system.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "support/expect_error.h"

namespace rex::linear_system_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

LinearSystem doubleIntegrator() {
  LinearSystem system{.A = MatrixXd::Zero(2, 2), .B = MatrixXd::Zero(2, 1)};
  system.A(0, 1) = system.B(1, 0) = 1;
  return system;
}

TEST(LinearSystem, FillsInWhatIsMeasured) {
  const LinearSystem system = completed(doubleIntegrator());
  EXPECT_EQ(system.C, MatrixXd::Identity(2, 2));
  EXPECT_EQ(system.D, MatrixXd::Zero(2, 1));
}

TEST(LinearSystem, SaysWhatDoesNotFit) {
  const auto expect = [](const auto& change, const char* text) {
    LinearSystem system = completed(doubleIntegrator());
    change(system);
    EXPECT_REX_ERROR(completed(system), text);
  };
  expect([](LinearSystem& s) { s.A.resize(0, 0); }, "linear system: found no state");
  expect([](LinearSystem& s) { s.A.setZero(2, 3); }, "columns of A: found a vector of size 3, wanted size 2");
  expect([](LinearSystem& s) { s.B.setZero(3, 1); }, "rows of B: found a vector of size 3");
  expect([](LinearSystem& s) { s.C.setZero(1, 3); }, "columns of C: found a vector of size 3");
  expect([](LinearSystem& s) { s.D.setZero(1, 1); }, "rows of D: found a vector of size 1");
  expect([](LinearSystem& s) { s.D.setZero(2, 2); }, "columns of D: found a vector of size 2");
  expect([](LinearSystem& s) { s.A(0, 0) = kNan; }, "matrix A: found entries that are not finite");
  expect([](LinearSystem& s) { s.B(0, 0) = kNan; }, "matrix B: found entries");
  expect([](LinearSystem& s) { s.C(0, 0) = kNan; }, "matrix C: found entries");
  expect([](LinearSystem& s) { s.D(0, 0) = kNan; }, "matrix D: found entries");
  expect([](LinearSystem& s) { s.step = 0; },
         "step of a linear system: found 0, wanted a positive, finite number");
}

// The double integrator in closed form; a random system by many short steps of Runge and Kutta.
TEST(Discretized, HoldsTheControlExactly) {
  const LinearSystem steps = discretized(doubleIntegrator(), 0.3);
  MatrixXd A(2, 2), B(2, 1);
  A << 1, 0.3, 0, 1;
  B << 0.045, 0.3;
  EXPECT_LT((steps.A - A).norm() + (steps.B - B).norm(), 1e-15);
  EXPECT_EQ(steps.step, 0.3);
  Rng rng(3);
  const LinearSystem random{.A = rng.normalVector(9).reshaped(3, 3), .B = rng.normalVector(6).reshaped(3, 2)};
  const VectorXd u = rng.normalVector(2), start = rng.normalVector(3);
  VectorXd x = start;
  constexpr int kSteps = 1000;
  const double h = 0.7 / kSteps;
  const auto rate = [&](const VectorXd& at) -> VectorXd { return random.A * at + random.B * u; };
  for (int i = 0; i < kSteps; ++i) {
    const VectorXd k1 = rate(x), k2 = rate(x + h / 2 * k1), k3 = rate(x + h / 2 * k2), k4 = rate(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  const LinearSystem held = discretized(random, 0.7);
  EXPECT_LT((held.A * start + held.B * u - x).norm(), 1e-11 * (1 + x.norm()));
  // A strong control, as of a tiny mass, does not cost digits.
  for (const double strong : {1e-200, 1e8, 1e12, 1e200}) {
    const MatrixXd one = MatrixXd::Identity(1, 1);
    const LinearSystem decaying = discretized({.A = -one, .B = strong * one}, 1);
    EXPECT_NEAR(decaying.A(0, 0), std::exp(-1.), 1e-15) << strong;
    EXPECT_NEAR(decaying.B(0, 0) / strong, 1 - std::exp(-1.), 1e-15) << strong;
  }
  EXPECT_REX_ERROR(discretized({.A = 800 * MatrixXd::Identity(1, 1), .B = MatrixXd::Ones(1, 1)}, 1),
                   "motion of the system in 1 s: found numbers that are not finite, wanted a shorter step");
  EXPECT_REX_ERROR(discretized(held, 0.1), "linear system: found discrete time, wanted continuous time");
  EXPECT_REX_ERROR(discretized(random, -1), "step of a linear system: found -1");
}

// Differences against what exact derivatives give, at zero, 1e-8 and random points.
TEST(Linearized, IsTheDerivative) {
  const auto f = [](const VectorXd& x, const VectorXd& u) {
    return VectorXd(Eigen::Vector2d(x[1], std::sin(x[0]) + x[1] * u[0]));
  };
  const auto exact = [](const VectorXd& x, const VectorXd& u) {
    MotionJacobians J{MatrixXd(2, 2), MatrixXd(2, 1)};
    J.A << 0, 1, std::cos(x[0]), u[0];
    J.B << 0, x[1];
    return J;
  };
  Rng rng(4);
  for (const VectorXd& x :
       {VectorXd(VectorXd::Zero(2)), VectorXd(VectorXd::Constant(2, 1e-8)), rng.normalVector(2)}) {
    const VectorXd u = rng.normalVector(1);
    const Linearization numeric = linearized(f, x, u), given = linearized(f, x, u, exact);
    EXPECT_LT((numeric.A - given.A).norm() + (numeric.B - given.B).norm(), 1e-10);
    EXPECT_EQ(numeric.value, f(x, u));
  }
}

// Erratum 32: A[2,3] = -5.88, A[4,3] = 11.76, B = (0, .8, 0, -.6) at the upright pole.
TEST(Linearized, GivesTheCartPoleOfTheErrata) {
  const VectorXd zero = VectorXd::Zero(4);
  const auto f = [](const VectorXd& x, const VectorXd& u) {
    const double c1 = 0.5, c2 = 0.5, l = 1, g = 9.8;
    const double s = std::sin(x[2]), c = std::cos(x[2]), drive = c1 * u[0] + c2 * x[3] * x[3] * s;
    const double turn = (g * s - c * drive) / (4 * l / 3 - c2 * c * c);
    return VectorXd(Eigen::Vector4d(x[1], drive - c2 * turn * c, x[3], turn));
  };
  const Linearization at = linearized(f, zero, VectorXd::Zero(1));
  EXPECT_LT(at.value.norm(), 1e-15);
  EXPECT_NEAR(at.A(1, 2), -5.88, 1e-9);
  EXPECT_NEAR(at.A(3, 2), 11.76, 1e-9);
  EXPECT_NEAR(at.B(1, 0), 0.8, 1e-9);
  EXPECT_NEAR(at.B(3, 0), -0.6, 1e-9);
}

TEST(Linearized, SaysWhatIsWrong) {
  const auto f = [](const VectorXd& x, const VectorXd&) { return x; };
  const VectorXd x = VectorXd::Ones(2), u = VectorXd::Ones(1);
  EXPECT_REX_ERROR(linearized(nullptr, x, u), "motion: found no function");
  EXPECT_REX_ERROR(linearized(f, VectorXd::Constant(2, kNan), u), "state x: number 0: found nan");
  EXPECT_REX_ERROR(linearized(f, x, VectorXd::Constant(1, kNan)), "control u: number 0: found nan");
  const auto longer = [](const VectorXd&, const VectorXd&) { return VectorXd(VectorXd::Zero(3)); };
  EXPECT_REX_ERROR(linearized(longer, x, u), "value of the motion: found a vector of size 3, wanted size 2");
  const auto broken = [](const VectorXd&, const VectorXd&) { return VectorXd(VectorXd::Constant(2, kNan)); };
  EXPECT_REX_ERROR(linearized(broken, x, u), "value of the motion: number 0: found nan");
  const auto derivative = [](int rowsA, int columnsA, int rowsB, int columnsB, double entry) {
    return [=](const VectorXd&, const VectorXd&) {
      return MotionJacobians{MatrixXd::Constant(rowsA, columnsA, entry),
                             MatrixXd::Constant(rowsB, columnsB, 2 * entry)};
    };
  };
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(3, 2, 2, 1, 0)), "rows of df/dx: found a vector of size 3");
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(2, 3, 2, 1, 0)),
                   "columns of df/dx: found a vector of size 3");
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(2, 2, 3, 1, 0)), "rows of df/du: found a vector of size 3");
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(2, 2, 2, 3, 0)),
                   "columns of df/du: found a vector of size 3");
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(2, 2, 2, 1, kNan)),
                   "df/dx: found entries that are not finite");
  EXPECT_REX_ERROR(linearized(f, x, u, derivative(2, 2, 2, 1, 1e308)),
                   "df/du: found entries that are not finite");
}

}  // namespace rex::linear_system_test
