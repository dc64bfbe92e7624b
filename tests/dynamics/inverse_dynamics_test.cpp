#include "dynamics/inverse_dynamics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/random_motion.h"
#include "support/world_frame_dynamics.h"

namespace rex::inverse_dynamics_test {

TEST(InverseDynamics, AgreesWithPlainRecursionInTheWorldFrame) {
  Rng rng(21);
  for (int i = 0; i < 200; ++i) {
    const Model model = randomModel(rng, 2 + i % 40, i % 2 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const Eigen::Vector3d gravity_W = 10 * rng.normalVector(3);
    const Eigen::VectorXd a = rng.normalVector(model.nv());
    const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a, gravity_W);
    const Eigen::VectorXd wanted = worldFrameInverseDynamics(model, at.q, at.v, a, gravity_W);
    EXPECT_LE((u - wanted).lpNorm<Eigen::Infinity>(), 1e-10 * wanted.lpNorm<Eigen::Infinity>()) << i;
  }
}

// Followers of several coordinates, and one that stands still.
TEST(InverseDynamics, AddsTheForcesOfJointsThatShareCoordinates) {
  Rng rng(22);
  for (const JointType type : kAllJointTypes) {
    SceneSpec spec = randomScene(rng, 4);
    for (JointSpec& joint : spec.joints) joint.type = type;
    spec.joints[2].mimic = spec.joints[0].name;
    if (positionCount(type) == 1) spec.joints[2].mimicRatio = 0;
    const Model model = compile(spec);
    const RandomMotion at(rng, model);
    const Eigen::VectorXd a = rng.normalVector(model.nv());
    const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a);
    const Eigen::VectorXd wanted = worldFrameInverseDynamics(model, at.q, at.v, a, earthGravity());
    EXPECT_LE((u - wanted).cwiseAbs().sum(), 1e-11 * wanted.cwiseAbs().sum()) << toString(type);
  }
}

TEST(InverseDynamics, TakesQuaternionsOfAnyLength) {
  Rng rng(23);
  const Model model = randomModel(rng, 25, Followers::kNone);
  RandomMotion at(rng, model);
  const Eigen::VectorXd a = rng.normalVector(model.nv());
  const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a);
  for (const double length : {1e-160, 1e-3, 1e200}) {
    RandomMotion scaled = at;
    for (const Link& link : model.links())
      if (link.kind == Link::Kind::kQuaternion) scaled.q.segment<4>(link.qIndex) *= length;
    EXPECT_TRUE(inverseDynamics(model, scaled.q, at.v, a).isApprox(u, 1e-12)) << length;
  }
}

// A point of 2 kg on a rod of 3 m that hangs along -z and swings about y.
TEST(InverseDynamics, HoldsAPendulum) {
  SceneSpec spec;
  spec.bodies = {{.name = "bob", .X_WB = {}, .mass = 2, .p_BBcm = {0, 0, -3}}};
  spec.bodies[0].inertia = Eigen::Matrix3d::Zero();
  spec.joints = {{.name = "pivot", .parent = "world", .child = "bob", .X_PF = {}, .X_MC = {}}};
  spec.joints[0].axis = Eigen::Vector3d::UnitY();
  const Model model = compile(spec);
  for (const double angle : {0., 1e-8, 0.7, -2.}) {
    const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, angle), v = Eigen::VectorXd::Constant(1, 5.);
    EXPECT_NEAR(gravityForces(model, q)[0], 2 * 9.81 * 3 * std::sin(angle), 1e-12);
    EXPECT_NEAR(gravityForces(model, q, {4, 0, 0})[0], 2 * 4 * 3 * std::cos(angle), 1e-12);
    EXPECT_NEAR(biasForces(model, q, v)[0], 2 * 9.81 * 3 * std::sin(angle), 1e-12);
    EXPECT_NEAR(biasForces(model, q, v, Eigen::Vector3d::Zero())[0], 0, 1e-12);
    EXPECT_NEAR(inverseDynamics(model, q, v, v, Eigen::Vector3d::Zero())[0], 5 * 2 * 9, 1e-12);
  }
}

TEST(InverseDynamics, NeedsNothingWhereNothingMoves) {
  SceneSpec spec;
  spec.bodies = {{.name = "table", .X_WB = {}, .mass = 20}};
  EXPECT_EQ(biasForces(compile(spec), Eigen::VectorXd(0), Eigen::VectorXd(0)).size(), 0);
}

TEST(InverseDynamics, NamesWrongSizesAndQuaternions) {
  Rng rng(24);
  const Model model = compile(randomScene(rng, 12));
  RandomMotion at(rng, model);
  const Eigen::VectorXd a = rng.normalVector(model.nv()), two = Eigen::Vector2d(1, 2);
  DynamicsWorkspace workspace;
  Eigen::VectorXd u(2);
  EXPECT_REX_ERROR(inverseDynamics(model, two, at.v, a),
                   "joint positions q: found a vector of size 2, wanted size 29");
  EXPECT_REX_ERROR(inverseDynamics(model, at.q, two, a),
                   "joint velocities v: found a vector of size 2, wanted size 27");
  EXPECT_REX_ERROR(inverseDynamics(model, at.q, at.v, two),
                   "joint accelerations a: found a vector of size 2, wanted size 27");
  EXPECT_REX_ERROR(inverseDynamics(model, at.q, at.v, a, earthGravity(), workspace, u),
                   "joint forces u: found a vector of size 2, wanted size 27");
  EXPECT_REX_ERROR(inverseDynamics(model, Eigen::VectorXd::Zero(model.nq()), at.v, a),
                   "quaternion: found (0, 0, 0, 0), wanted finite numbers, not all zero");
  for (const Link& link : model.links()) {
    if (link.kind == Link::Kind::kQuaternion) at.q[link.qIndex] = std::numeric_limits<double>::infinity();
  }
  EXPECT_REX_ERROR(inverseDynamics(model, at.q, at.v, a), "quaternion: found (inf, ");
}

TEST(InverseDynamics, WorksInPlace) {
  Rng rng(26);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const RandomMotion at(rng, model);
  const Eigen::VectorXd a = rng.normalVector(model.nv());
  DynamicsWorkspace workspace;
  Eigen::VectorXd x = a;
  inverseDynamics(model, at.q, at.v, x, earthGravity(), workspace, x);
  EXPECT_EQ(x, inverseDynamics(model, at.q, at.v, a));
  x = at.v;
  inverseDynamics(model, at.q, x, a, earthGravity(), workspace, x);
  EXPECT_EQ(x, inverseDynamics(model, at.q, at.v, a));
  x = at.v;
  biasForces(model, at.q, x, earthGravity(), workspace, x);
  EXPECT_EQ(x, biasForces(model, at.q, at.v));
  gravityForces(model, at.q, earthGravity(), workspace, x);
  EXPECT_EQ(x, gravityForces(model, at.q));
}

#ifndef __SANITIZE_ADDRESS__
TEST(InverseDynamics, AllocatesOnlyAtFirst) {
  Rng rng(25);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const RandomMotion at(rng, model);
  const Eigen::VectorXd a = rng.normalVector(model.nv());
  Eigen::VectorXd u(model.nv());
  DynamicsWorkspace workspace;
  const long before = allocations();
  inverseDynamics(model, at.q, at.v, a, earthGravity(), workspace, u);
  const long first = allocations();
  inverseDynamics(model, at.q, at.v, a, earthGravity(), workspace, u);
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);

  biasForces(model, at.q, at.v, earthGravity(), workspace, u);
  const long withZeros = allocations();
  biasForces(model, at.q, at.v, earthGravity(), workspace, u);
  gravityForces(model, at.q, earthGravity(), workspace, u);
  EXPECT_EQ(allocations(), withZeros);
}
#endif

}  // namespace rex::inverse_dynamics_test
