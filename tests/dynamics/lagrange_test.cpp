#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/rng.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "formats/ors_reader.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::lagrange_test {

using Eigen::Vector2d;
using Eigen::VectorXd;

TEST(EulerLagrange, OfThePendulumOfTheScript) {
  const double m = 1.5, l = 0.7, I = 0.02, g = 9.81;
  const Lagrangian L = [&](const VectorXd& q, const VectorXd& v) {
    return (m * l * l + I) * v[0] * v[0] / 2 + m * g * l * std::cos(q[0]);
  };
  Rng rng(341);
  for (const double size : {0., 1e-8, 1., 10.}) {
    const VectorXd q = size * rng.normalVector(1), v = size * rng.normalVector(1),
                   a = size * rng.normalVector(1);
    const double wanted = (m * l * l + I) * a[0] + m * g * l * std::sin(q[0]);
    EXPECT_NEAR(eulerLagrangeForce(L, q, v, a)[0], wanted, 1e-10 * std::max(1., std::abs(wanted))) << size;
  }
}

// Exercise 12.6.1: x of the wheel, angle of the pendulum. Energies from the velocities of both bodies, M and
// F derived by hand.
struct WheeledPendulum {
  double mA = .05, mB = .5, r = .05, l = .5, IA = 3.125e-5, IB = .005, g = 9.8;

  double lagrangian(const VectorXd& q, const VectorXd& v) const {
    const Vector2d vB(v[0] + l * v[1] * std::cos(q[1]), -l * v[1] * std::sin(q[1]));
    const double kinetic =
        mA * v[0] * v[0] + IA * std::pow(v[0] / r, 2) + mB * vB.squaredNorm() + IB * v[1] * v[1];
    return kinetic / 2 - mA * g * r - mB * g * (r + l * std::cos(q[1]));
  }
  Eigen::Matrix2d massMatrix(double angle) const {
    const double mixed = mB * l * std::cos(angle);
    return Eigen::Matrix2d{{mA + mB + IA / (r * r), mixed}, {mixed, mB * l * l + IB}};
  }
  Vector2d bias(double angle, double rate) const {
    return {-mB * l * std::sin(angle) * rate * rate, -mB * g * l * std::sin(angle)};
  }
};

TEST(EulerLagrange, OfTheWheeledPendulum) {
  const WheeledPendulum racer;
  const Lagrangian L = [&](const VectorXd& q, const VectorXd& v) { return racer.lagrangian(q, v); };
  Rng rng(342);
  for (const double size : {0., 1e-8, 1., 3.}) {
    const VectorXd q = size * rng.normalVector(2), v = size * rng.normalVector(2),
                   a = size * rng.normalVector(2);
    const EquationOfMotion motion = equationOfMotion(L, q, v);
    const Vector2d F = racer.bias(q[1], v[1]);
    EXPECT_LE((motion.M - racer.massMatrix(q[1])).norm(), 1e-9) << size;
    EXPECT_LE((motion.F - F).norm(), 1e-10 * std::max(1., F.norm())) << size;
    const Vector2d u = racer.massMatrix(q[1]) * a + F;
    EXPECT_LE((eulerLagrangeForce(L, q, v, a) - u).norm(), 1e-10 * std::max(1., u.norm())) << size;
  }
  const Eigen::Matrix2d upright = equationOfMotion(L, Vector2d::Zero(), Vector2d::Zero()).M;
  EXPECT_LE((upright - Eigen::Matrix2d{{.5625, .25}, {.25, .13}}).norm(), 1e-9) << upright;
}

class LagrangianOfScene : public testing::TestWithParam<const char*> {};

TEST_P(LagrangianOfScene, GivesInverseDynamics) {
  const Model model = compile(readOrs(sourcePath("data/robots") / (std::string(GetParam()) + ".ors")).spec);
  const Lagrangian L = [&](const VectorXd& q, const VectorXd& v) {
    const Energy parts = energy(model, q, v);
    return parts.kinetic - parts.potential;
  };
  Rng rng(343);
  const VectorXd q = rng.normalVector(model.nq()), v = rng.normalVector(model.nv()),
                 a = rng.normalVector(model.nv());
  const VectorXd u = inverseDynamics(model, q, v, a);
  EXPECT_LE((eulerLagrangeForce(L, q, v, a) - u).norm(), 1e-9 * u.norm());
  const EquationOfMotion byEnergy = equationOfMotion(L, q, v), wanted = equationOfMotion(model, q, v);
  EXPECT_LE((byEnergy.M - wanted.M).norm(), 1e-9 * (wanted.M.norm() + wanted.F.norm()));
  EXPECT_LE((byEnergy.F - wanted.F).norm(), 1e-9 * wanted.F.norm());
}

INSTANTIATE_TEST_SUITE_P(OfTheCourse, LagrangianOfScene, testing::Values("arm3", "arm7", "pegArm", "pegArm2"),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(EulerLagrange, NamesWrongSizesAndNumbers) {
  const Lagrangian L = [](const VectorXd& q, const VectorXd&) { return q[0]; };
  const VectorXd two = VectorXd::Zero(2), three = VectorXd::Zero(3);
  EXPECT_REX_ERROR(eulerLagrangeForce(L, two, three, two),
                   "velocities v: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(eulerLagrangeForce(L, two, two, three),
                   "accelerations a: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(equationOfMotion(L, two, three), "velocities v: found a vector of size 3, wanted size 2");
  const Lagrangian broken = [](const VectorXd&, const VectorXd&) {
    return std::numeric_limits<double>::quiet_NaN();
  };
  EXPECT_REX_ERROR(eulerLagrangeForce(broken, two, two, two),
                   "Lagrangian: found nan, wanted a finite number");
}

}  // namespace rex::lagrange_test
