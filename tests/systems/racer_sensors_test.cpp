#include "systems/racer_sensors.h"

#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "systems/racer.h"

namespace rex::racer_sensors_test {

using Eigen::Vector4d;
using Eigen::VectorXd;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kRadius = 0.05;

TEST(RacerSensors, AreTheFormulasOfTheirDocument) {
  constexpr double s = 1.021875, phi = 0.16, kappa = 0.0510417;
  Rng rng(1);
  for (const double size : {0., 1e-8, 1., 10.}) {
    const Vector4d x = size * rng.normalVector(4), y = RacerSensors{}.measured(x, kRadius);
    const double angle = x[1], rate = x[3];
    EXPECT_NEAR(y[0], s * std::cos(angle + phi) - kappa * rate * rate * std::cos(phi),
                1e-14 * (1 + rate * rate));
    EXPECT_NEAR(y[1], s * std::sin(angle + phi) - kappa * rate * rate * std::sin(phi),
                1e-14 * (1 + rate * rate));
    EXPECT_NEAR(y[2], rate - 0.0417273, 1e-14);
    EXPECT_NEAR(y[3], x[0] / kRadius - angle, 1e-13 * (1 + std::abs(x[0])));
  }
}

// At rest two accelerometers at a right angle read gravity; spinning adds what pulls towards the axis, along
// the body, in units of g: kappa is a length over g.
TEST(RacerSensors, ReadGravityAndSpin) {
  const RacerSensors sensors{.s = 1, .gyroBias = 0};
  for (const double angle : {-0.7, 0., 0.3}) {
    const Vector4d rest = sensors.measured(Vector4d(0, angle, 0, 0), kRadius);
    EXPECT_NEAR(rest.head<2>().norm(), 1, 1e-15);
    EXPECT_NEAR(std::atan2(rest[1], rest[0]) - sensors.phi, angle, 1e-15);
    const Vector4d spun = sensors.measured(Vector4d(0, angle, 0, 3), kRadius);
    EXPECT_NEAR((spun - rest).head<2>().norm(), 9 * sensors.kappa, 1e-14);
  }
  EXPECT_NEAR(RacerSensors{}.kappa * RacerDynamics{}.g, RacerDynamics{}.l, 1e-3);  // they sit at the centre
}

TEST(RacerSensors, JacobianIsTheDerivative) {
  Rng rng(2);
  const RacerSensors sensors{.s = 0.9, .phi = -0.3, .kappa = 0.07, .gyroBias = 0.2};
  for (const double size : {0., 1e-8, 1.}) {
    const Vector4d x = size * rng.normalVector(4);
    const auto measure = [&](const VectorXd& at) { return VectorXd(sensors.measured(at, 0.2)); };
    const JacobianCheck check = checkJacobian(measure, sensors.jacobian(x, 0.2), x, 1e-8);
    EXPECT_TRUE(check.ok) << size << check.message;
  }
}

// Erratum 33: u = w' y on (1, y) near rest. Wheel velocity is not among y, so the coefficient of s
// in the characteristic polynomial stays zero, and some pole is never on the left.
TEST(RacerSensors, AloneCannotBeStabilized) {
  const LinearizedPlant plant = RacerDynamics{}.linearized(Vector4d::Zero(), 0);
  const Eigen::Matrix4d C = RacerSensors{}.jacobian(Vector4d::Zero(), kRadius);
  const auto loop = [&](const Vector4d& w) {
    return Eigen::Matrix4d(plant.A + plant.B * (w.transpose() * C));
  };
  const auto rightmost = [](const Eigen::MatrixXd& A) { return A.eigenvalues().real().maxCoeff(); };
  // The coefficient is minus the sum of the principal minors of order three.
  const auto coefficient = [](const Eigen::Matrix4d& A) {
    double sum = 0;
    for (int left = 0; left < 4; ++left) {
      Eigen::Matrix3d minor;
      for (int i = 0; i < 9; ++i) minor(i / 3, i % 3) = A(i / 3 + (i / 3 >= left), i % 3 + (i % 3 >= left));
      sum -= minor.determinant();
    }
    return sum;
  };
  Rng rng(3);
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 2000; ++i) {
    const Vector4d w = Vector4d(3, 3, 1, 0.1).cwiseProduct(rng.normalVector(4));
    const Eigen::Matrix4d A = loop(w);
    ASSERT_NEAR(coefficient(A), 0, 1e-9 * std::pow(A.norm(), 3));
    best = std::min(best, rightmost(A));
  }
  EXPECT_GT(best, -1e-5);
  // Zero is reached: theta and theta' alone hold the body upright, and the wheel rolls on.
  const Vector4d upright(0, 3, 1, 0);
  EXPECT_NEAR(rightmost(loop(upright)), 0, 1e-5);

  // With wheel velocity the coefficient is free.
  const Eigen::RowVector4d wheelSpeed(0, 0, 1 / kRadius, -1);
  EXPECT_GT(std::abs(coefficient(loop(upright) + plant.B * wheelSpeed)), 1);
}

TEST(RacerSensors, RefuseWhatHasNoMeaning) {
  const Vector4d x = Vector4d::Zero();
  EXPECT_REX_ERROR(RacerSensors{}.measured(Vector4d(kNan, 0, 0, 0), 1), "racer: state: number 0: found nan");
  EXPECT_REX_ERROR(RacerSensors{}.jacobian(Vector4d(0, kNan, 0, 0), 1), "racer: state: number 1: found nan");
  EXPECT_REX_ERROR(RacerSensors{}.measured(x, 0),
                   "racer: radius r: found 0, wanted a positive, finite number");
  EXPECT_REX_ERROR(RacerSensors{.s = kNan}.measured(x, 1), "racer: sensor constant s: found nan");
  EXPECT_REX_ERROR(RacerSensors{.phi = kNan}.measured(x, 1), "racer: sensor constant phi: found nan");
  EXPECT_REX_ERROR(RacerSensors{.kappa = kNan}.measured(x, 1), "racer: sensor constant kappa: found nan");
  EXPECT_REX_ERROR(RacerSensors{.gyroBias = kNan}.jacobian(x, 1), "racer: bias of the gyroscope: found nan");
}

}  // namespace rex::racer_sensors_test
