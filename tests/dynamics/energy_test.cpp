#include "dynamics/energy.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "kinematics/center_of_mass.h"
#include "scene/state.h"
#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/mass_matrix_by_jacobians.h"
#include "support/random_motion.h"

namespace rex::energy_test {

const Eigen::Vector3d kGravity(0.5, -1, -9.81);

TEST(Energy, IsThatOfTheMassMatrixAndTheCentreOfMass) {
  Rng rng(301);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, Followers::kSome);
    const Eigen::VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
    const Energy found = energy(model, q, v, kGravity);
    const double kinetic = v.dot(massMatrixByJacobians(model, q) * v) / 2;
    const double potential = -model.mass() * kGravity.dot(centerOfMass(model, forwardKinematics(model, q)));
    EXPECT_NEAR(found.kinetic, kinetic, 1e-12 * kinetic);
    EXPECT_NEAR(found.potential, potential, 1e-11 * model.mass() * kGravity.norm());
    EXPECT_EQ(found.total(), found.kinetic + found.potential);
  }
}

// Slide 3:21, with the rod's mass at its centre.
TEST(Energy, OfAPendulum) {
  SceneSpec spec;
  spec.bodies = {{.name = "post", .X_WB = {}},
                 {.name = "rod",
                  .X_WB = {},
                  .mass = 2,
                  .p_BBcm = {0, 0, -0.5},
                  .inertia = Eigen::Vector3d(0, 0.1, 0).asDiagonal()}};
  spec.joints = {
      {.name = "pin", .parent = "post", .child = "rod", .X_PF = {}, .X_MC = {}, .axis = {0, 1, 0}}};
  const Model model = compile(spec);
  const Energy found = energy(model, Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Constant(1, 4));
  EXPECT_DOUBLE_EQ(found.kinetic, 0.5 * (2 * 0.25 + 0.1) * 16);
  EXPECT_DOUBLE_EQ(found.potential, -2 * 9.81 * 0.5 * std::cos(0.3));
}

class EnergyGradientOfRandomTree : public testing::TestWithParam<double> {};

TEST_P(EnergyGradientOfRandomTree, AgreesWithDifferences) {
  Rng rng(302);
  for (int i = 0; i < 10; ++i) {
    const Model model = randomModel(rng, 13 + 2 * i, Followers::kSome);
    const Eigen::VectorXd q =
        integrate(model, model.initialPositions(), GetParam() * rng.normalVector(model.nv()));
    const Eigen::VectorXd v = GetParam() * rng.normalVector(model.nv());
    const EnergyGradient gradient = energyGradient(model, q, v, kGravity);
    const auto total = [&](const Eigen::VectorXd& atQ, const Eigen::VectorXd& atV) {
      return Eigen::VectorXd::Constant(1, energy(model, atQ, atV, kGravity).total());
    };
    const JacobianCheck byPosition =
        checkJacobian([&](const Eigen::VectorXd& way) { return total(integrate(model, q, way), v); },
                      gradient.byPosition.transpose(), Eigen::VectorXd::Zero(model.nv()));
    EXPECT_TRUE(byPosition.ok) << byPosition.message;
    const JacobianCheck byVelocity = checkJacobian([&](const Eigen::VectorXd& atV) { return total(q, atV); },
                                                   gradient.byVelocity.transpose(), v);
    EXPECT_TRUE(byVelocity.ok) << byVelocity.message;
    EXPECT_LE((gradient.byVelocity - massMatrixByJacobians(model, q) * v).norm(),
              1e-12 * gradient.byVelocity.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(AtZeroTinyAndRandom, EnergyGradientOfRandomTree, testing::Values(0., 1e-8, 1.));

TEST(EnergyGradient, IsGravityForcesAtRest) {
  Rng rng(303);
  const Model model = randomModel(rng, 40, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq()), rest = Eigen::VectorXd::Zero(model.nv());
  const EnergyGradient gradient = energyGradient(model, q, rest);
  EXPECT_LE((gradient.byPosition - gravityForces(model, q)).norm(), 1e-12 * gradient.byPosition.norm());
  EXPECT_EQ(gradient.byVelocity, rest);
}

#ifndef __SANITIZE_ADDRESS__
TEST(Energy, AllocatesOnlyAtFirst) {
  Rng rng(305);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
  DynamicsWorkspace workspace;
  const long before = allocations();
  const double total = energy(model, q, v, kGravity, workspace).total();
  const long first = allocations();
  EXPECT_EQ(energy(model, q, v, kGravity, workspace).total(), total);
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);
}
#endif

TEST(Energy, NamesWrongSizes) {
  Rng rng(304);
  const Model model = compile(randomScene(rng, 3));
  const Eigen::VectorXd two = Eigen::VectorXd::Zero(2), five = Eigen::VectorXd::Zero(5);
  EXPECT_REX_ERROR(energy(model, two, five), "joint velocities v: found a vector of size 5, wanted size 2");
  EXPECT_REX_ERROR(energy(model, five, two), "joint positions q: found a vector of size 5, wanted size 2");
  EXPECT_REX_ERROR(energyGradient(model, two, five),
                   "joint velocities v: found a vector of size 5, wanted size 2");
}

}  // namespace rex::energy_test
