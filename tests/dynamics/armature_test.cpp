// What turns with a joint alone, such as the rotor of its motor. Random trees with armatures are in all other
// tests of this module, whose references know it.
#include <gtest/gtest.h>

#include "dynamics/dynamics_batch.h"
#include "dynamics/energy.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/forward_dynamics.h"
#include "dynamics/stepper.h"
#include "support/random_motion.h"

namespace rex::armature_test {

using Eigen::VectorXd;

SceneSpec treeWith(Rng& rng, int bodies, double armature) {
  SceneSpec spec = randomScene(rng, bodies);
  for (JointSpec& joint : spec.joints) joint.armature = armature * rng.uniform(0.1, 1);
  return spec;
}

TEST(Armature, IsOnTheDiagonal) {
  Rng rng(1);
  SceneSpec spec = treeWith(rng, 25, 2);
  const Model with = compile(spec);
  for (JointSpec& joint : spec.joints) joint.armature = 0;
  const Model without = compile(spec);
  const RandomMotion at(rng, with);
  const Eigen::MatrixXd added = massMatrix(with, at.q) - massMatrix(without, at.q);
  EXPECT_LT((added - Eigen::MatrixXd(with.armature().asDiagonal())).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(with.armature().minCoeff(), 0.2 - 1e-12);
  const VectorXd a = rng.normalVector(with.nv());
  const VectorXd force = inverseDynamics(with, at.q, at.v, a) - inverseDynamics(without, at.q, at.v, a);
  EXPECT_LT((force - with.armature().cwiseProduct(a)).norm(), 1e-9);
  EXPECT_EQ(biasForces(with, at.q, at.v), biasForces(without, at.q, at.v));
}

// By recursion, by the mass matrix, and in blocks, far below and above the inertia of the bodies.
TEST(Armature, SlowsForwardDynamics) {
  for (const double armature : {1e-6, 1., 1e4}) {
    Rng rng(2);
    const Model model = compile(treeWith(rng, 30, armature));
    Eigen::MatrixXd Q(model.nq(), 9), V(model.nv(), 9), A(model.nv(), 9), U(model.nv(), 9), back = A;
    for (int k = 0; k < 9; ++k) {
      const RandomMotion at(rng, model);
      Q.col(k) = at.q, V.col(k) = at.v, A.col(k) = rng.normalVector(model.nv());
      U.col(k) = inverseDynamics(model, at.q, at.v, A.col(k));
      const VectorXd byRecursion = forwardDynamics(model, at.q, at.v, U.col(k));
      const VectorXd byMatrix = forwardDynamicsByMassMatrix(model, at.q, at.v, U.col(k));
      EXPECT_LT((byRecursion - A.col(k)).norm(), 1e-8 * A.col(k).norm()) << armature;
      EXPECT_LT((byMatrix - A.col(k)).norm(), 1e-8 * A.col(k).norm()) << armature;
    }
    DynamicsWorkspace workspace;
    forwardDynamicsBatch(model, Q, V, U, earthGravity(), workspace, back);
    EXPECT_LT((back - A).norm(), 1e-8 * A.norm()) << armature;
    // In place.
    inverseDynamics(model, Q.col(0), V.col(0), A.col(0), earthGravity(), workspace, A.col(0));
    EXPECT_EQ(A.col(0), U.col(0));
  }
}

TEST(Armature, OfAJointThatMimicsCountsWithTheSquareOfItsRatio) {
  SceneSpec spec;
  for (const char* name : {"a", "b"}) {
    BodySpec body{.name = name, .X_WB = {}, .mass = 1};
    body.inertia = Eigen::Matrix3d::Identity();
    spec.bodies.push_back(body);
    JointSpec joint{
        .name = std::string("to-") + name, .parent = "world", .child = name, .X_PF = {}, .X_MC = {}};
    joint.armature = 2;
    spec.joints.push_back(joint);
  }
  spec.joints[1].mimic = "to-a";
  spec.joints[1].mimicRatio = -3;
  const Model model = compile(spec);
  const VectorXd q = VectorXd::Constant(1, .4), v = VectorXd::Constant(1, 5);
  EXPECT_DOUBLE_EQ(model.armature()[0], 2 + 9 * 2);
  EXPECT_NEAR(massMatrix(model, q)(0, 0), (1 + 2) + 9 * (1 + 2), 1e-12);
  EXPECT_NEAR(inverseDynamics(model, q, v, VectorXd::Constant(1, 2))[0], 60, 1e-12);
  EXPECT_NEAR(forwardDynamics(model, q, v, VectorXd::Constant(1, 60))[0], 2, 1e-12);
  EXPECT_NEAR(energy(model, q, v, Eigen::Vector3d::Zero()).kinetic, 30 * 25 / 2., 1e-10);
}

// A joint without mass behind it accelerates as its armature says.
TEST(Armature, MovesWhatHasNoMass) {
  SceneSpec spec;
  spec.bodies.push_back({.name = "b", .X_WB = {}});
  spec.joints.push_back({.name = "j", .parent = "world", .child = "b", .X_PF = {}, .X_MC = {}});
  spec.joints[0].armature = .5;
  const VectorXd zero = VectorXd::Zero(1), one = VectorXd::Ones(1);
  EXPECT_DOUBLE_EQ(forwardDynamics(compile(spec), zero, zero, one)[0], 2);
}

TEST(Armature, KeepsItsEnergy) {
  Rng rng(3);
  const Model model = compile(treeWith(rng, 9, 1));
  for (const auto& [integrator, most] :
       {std::pair(Integrator::kRungeKutta4, 1e-7), std::pair(Integrator::kLeapfrog, 2e-3)}) {
    Stepper stepper(model, {.integrator = integrator});
    State state{randomPositions(rng, model.nq()), VectorXd::Zero(model.nv())};
    state.q = integrate(model, state.q, state.v);
    const double before = energy(model, state.q, state.v).total();
    for (int i = 0; i < 500; ++i) stepper.step(state, VectorXd::Zero(model.nv()), 1e-3);
    const Energy after = energy(model, state.q, state.v);
    EXPECT_LT(std::abs(after.total() - before), most * after.kinetic) << after.kinetic;
    EXPECT_GT(after.kinetic, 1);
  }
}

}  // namespace rex::armature_test
