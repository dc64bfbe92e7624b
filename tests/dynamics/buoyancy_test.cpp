// Bodies whose weight is carried in part: by inverse and forward dynamics, in blocks, in derivatives and
// energies.
#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/derivatives.h"
#include "dynamics/dynamics_batch.h"
#include "dynamics/energy.h"
#include "dynamics/forward_dynamics.h"
#include "support/random_motion.h"

namespace rex::buoyancy_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

const Eigen::Vector3d kGravity(1, -2, -9);

// With mimics, if there are as many bodies as those take.
SceneSpec floating(Rng& rng, int bodies, bool hasMimics) {
  SceneSpec spec = randomScene(rng, bodies);
  if (hasMimics) addDetails(rng, spec);
  for (BodySpec& body : spec.bodies) {
    body.shapes.clear();
    body.buoyancy = rng.uniform(-0.5, 1.5);
  }
  for (JointSpec& joint : spec.joints) joint.stiffness = 0;
  spec.worldShapes.clear();
  return spec;
}

std::vector<Wrench> lifts(const Model& model) {
  std::vector<Wrench> all;
  for (std::size_t i = 1; i < model.bodies().size(); ++i) {
    const Body& body = model.bodies()[i];
    all.push_back({.body = BodyId{static_cast<int>(i)},
                   .p_BQ = body.p_BBcm,
                   .force_W = -body.buoyancy * body.mass * kGravity});
  }
  return all;
}

TEST(Buoyancy, IsAForceAtTheCentreOfMass) {
  Rng rng(1);
  for (const bool hasMimics : {false, true}) {
    SceneSpec spec = floating(rng, 25, hasMimics);
    const Model with = compile(spec);
    for (BodySpec& body : spec.bodies) body.buoyancy = 0;
    const Model without = compile(spec);
    EXPECT_TRUE(with.hasBuoyancy());
    EXPECT_FALSE(without.hasBuoyancy());
    const RandomMotion at(rng, with);
    const VectorXd a = rng.normalVector(with.nv());
    const VectorXd lift = wrenchForces(with, forwardKinematics(with, at.q), lifts(with));
    const VectorXd wanted = inverseDynamics(without, at.q, at.v, a, kGravity) - lift;
    EXPECT_LT((inverseDynamics(with, at.q, at.v, a, kGravity) - wanted).norm(), 1e-11 * wanted.norm());
    const VectorXd there = forwardDynamics(without, at.q, at.v, a + lift, kGravity);
    EXPECT_LT((forwardDynamics(with, at.q, at.v, a, kGravity) - there).norm(), 1e-9 * there.norm());
  }
}

TEST(Buoyancy, LetsBodiesFloat) {
  Rng rng(2);
  SceneSpec spec = floating(rng, 20, false);
  for (BodySpec& body : spec.bodies) body.buoyancy = 1;
  const Model model = compile(spec);
  const VectorXd q = randomPositions(rng, model.nq()), none = VectorXd::Zero(model.nv());
  EXPECT_LT(gravityForces(model, q).norm(), 1e-11 * model.mass());
  EXPECT_NEAR(energy(model, q, none).potential, 0, 1e-10 * model.mass());
}

TEST(Buoyancy, IsInEnergies) {
  Rng rng(3);
  const Model model = compile(floating(rng, 30, true));
  const VectorXd q = randomPositions(rng, model.nq()), none = VectorXd::Zero(model.nv());
  const auto potential = [&](const VectorXd& way) {
    return VectorXd::Constant(1, energy(model, integrate(model, q, way), none, kGravity).potential);
  };
  const VectorXd force = gravityForces(model, q, kGravity);
  const JacobianCheck check = checkJacobian(potential, force.transpose(), none);
  EXPECT_TRUE(check.ok) << check.message;
  EXPECT_LT((energyGradient(model, q, none, kGravity).byPosition - force).norm(), 1e-10 * force.norm());
}

TEST(Buoyancy, IsInBlocks) {
  Rng rng(4);
  for (const bool hasMimics : {false, true}) {
    const Model model = compile(floating(rng, 20, hasMimics));
    MatrixXd Q(model.nq(), 5), V(model.nv(), 5), A = V, U = V, back = V;
    for (int k = 0; k < 5; ++k) {
      const RandomMotion at(rng, model);
      Q.col(k) = at.q, V.col(k) = at.v, A.col(k) = rng.normalVector(model.nv());
    }
    DynamicsWorkspace workspace;
    inverseDynamicsBatch(model, Q, V, A, kGravity, workspace, U);
    forwardDynamicsBatch(model, Q, V, U, kGravity, workspace, back);
    EXPECT_LT((back - A).norm(), 1e-8 * A.norm());
    for (int k = 0; k < 5; ++k)
      EXPECT_EQ(U.col(k), inverseDynamics(model, Q.col(k), V.col(k), A.col(k), kGravity));
  }
}

TEST(Buoyancy, IsInDerivatives) {
  Rng rng(5);
  for (int i = 0; i < 10; ++i) {
    const Model model = compile(floating(rng, 12 + 2 * i, i % 2 == 1));
    const RandomMotion at(rng, model);
    const VectorXd a = rng.normalVector(model.nv()), none = VectorXd::Zero(model.nv());
    const auto force = [&](const VectorXd& way) {
      return inverseDynamics(model, integrate(model, at.q, way), at.v, a, kGravity);
    };
    const JacobianCheck check =
        checkJacobian(force, inverseDynamicsDerivatives(model, at.q, at.v, a, kGravity).u_q, none);
    EXPECT_TRUE(check.ok) << i << ": " << check.message;
    const auto acceleration = [&](const VectorXd& way) {
      return forwardDynamics(model, integrate(model, at.q, way), at.v, a, kGravity);
    };
    const JacobianCheck forward =
        checkJacobian(acceleration, forwardDynamicsDerivatives(model, at.q, at.v, a, kGravity).a_q, none);
    EXPECT_TRUE(forward.ok) << i << ": " << forward.message;
  }
}

}  // namespace rex::buoyancy_test
