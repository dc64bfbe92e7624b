#include "locomotion/whole_body_control.h"

#include <cmath>

#include "base/rng.h"
#include "dynamics/centroidal.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"
#include "locomotion/humanoid.h"
#include "support/expect_error.h"

namespace rex::whole_body_control_test {

using Eigen::Vector3d;
using Eigen::VectorXd;

WholeBodyGoal atRest(const Model& model) {
  WholeBodyGoal goal;
  goal.joints = VectorXd::Zero(model.nv());
  return goal;
}

// Newton and Euler for all bodies, from the accelerations alone: what acts besides gravity, and where.
ZeroMomentPoint reactionOf(const Humanoid& robot, const State& state, const WholeBodyForces& forces) {
  return zmpOfMotion(robot.model, state.q, state.v, forces.a);
}

TEST(WholeBodyControl, StandsStill) {
  const Humanoid robot;
  State state = initialState(robot.model);
  state.q = robot.home({.footsteps = straightFootsteps(1, 0, .19)});
  const WholeBodyControl control(robot.model, robot.legs, {});
  const WholeBodyForces forces = control.forces(state, atRest(robot.model));
  ASSERT_EQ(forces.status, QuadraticStatus::kOptimal);
  EXPECT_LT(forces.residual, 1e-9);
  const double weight = robot.model.mass() * 9.81;
  ASSERT_EQ(forces.contacts.size(), 8u);
  const ZeroMomentPoint ground = zmpOfContacts(forces.contacts);
  EXPECT_NEAR(ground.force_W.z(), weight, 1e-3 * weight);
  EXPECT_LT(ground.force_W.head<2>().norm(), 1e-3 * weight);
  const Vector3d center = centerOfMass(robot.model, forwardKinematics(robot.model, state.q));
  EXPECT_LT((ground.p_W - center).head<2>().norm(), 1e-3);
  EXPECT_LT(forces.a.cwiseAbs().maxCoeff(), 0.1);
}

// Moving anyhow, on both feet, one and none, also with goals that no limits allow.
TEST(WholeBodyControl, ObeysTheEquationOfMotionAndAllLimits) {
  const Humanoid robot;
  const Model& model = robot.model;
  Rng rng(3);
  bool isEffortReached = false, isFrictionReached = false;
  for (int round = 0; round < 12; ++round) {
    State state = initialState(model);
    state.q = integrate(model, robot.start, 0.1 * rng.uniformVector(model.nv(), -1, 1));
    state.v = 0.5 * rng.uniformVector(model.nv(), -1, 1);
    WholeBodyGoal goal = atRest(model);
    goal.left.stands = round % 3 != 2;
    goal.right.stands = round % 3 == 0;
    const double size = round < 6 ? 1 : 60;
    goal.center_W = size * rng.uniformVector(3, -1, 1);
    goal.trunk_W = size * rng.uniformVector(3, -1, 1);
    for (FootGoal* foot : {&goal.left, &goal.right})
      if (!foot->stands) foot->acceleration = 5 * size * rng.uniformVector(6, -1, 1);
    const WholeBodyOptions options;
    const WholeBodyControl control(model, robot.legs, {}, options);
    const WholeBodyForces forces = control.forces(state, goal);
    ASSERT_EQ(forces.status, QuadraticStatus::kOptimal) << round;
    EXPECT_LT(forces.residual, 1e-8);
    VectorXd u = inverseDynamics(model, state.q, state.v, forces.a);
    const BodyPoses poses = forwardKinematics(model, state.q);
    for (std::size_t i = 0; i < forces.contacts.size(); ++i) {
      const ContactForce& contact = forces.contacts[i];
      const BodyId foot = goal.left.stands && i < 4 ? robot.legs.leftFoot : robot.legs.rightFoot;
      const Vector3d p_FC = poses[foot].inverse() * contact.p_WC;
      u -= positionJacobian(model, poses, foot, p_FC).transpose() * contact.force_W;
      const Vector3d& f = contact.force_W;
      EXPECT_LE(std::max(std::abs(f.x()), std::abs(f.y())), options.friction * f.z() + 1e-6);
      isFrictionReached |= f.z() > 1 && std::abs(f.x()) > options.friction * f.z() - 1e-6;
    }
    EXPECT_LT((u - forces.u).cwiseAbs().maxCoeff(), 1e-6) << round;
    for (const Joint& joint : model.joints()) {
      if (joint.type == JointType::kFree) {
        EXPECT_TRUE(forces.u.segment<6>(joint.vIndex).isZero(0));
      } else {
        EXPECT_LE(std::abs(forces.u[joint.vIndex]), joint.maxEffort);
        isEffortReached |= std::abs(forces.u[joint.vIndex]) == joint.maxEffort;
      }
    }
    // The same with the last active rows as a guess.
    EXPECT_LT((control.forces(state, goal, forces.active).a - forces.a).cwiseAbs().maxCoeff(), 1e-5);
  }
  EXPECT_TRUE(isEffortReached);
  EXPECT_TRUE(isFrictionReached);
}

// By Newton and Euler, from the accelerations: the ground reaction is that of the contacts, and it moves the
// centre of mass as wanted.
TEST(WholeBodyControl, MovesTheCentreOfMassByTheGroundAlone) {
  const Humanoid robot;
  State state = initialState(robot.model);
  state.q = robot.home({.footsteps = straightFootsteps(1, 0, .19)});
  const WholeBodyControl control(robot.model, robot.legs, {});
  for (const Vector3d& wanted : {Vector3d(.4, 0, 0), Vector3d(0, -.5, 0), Vector3d(.1, .2, 1)}) {
    WholeBodyGoal goal = atRest(robot.model);
    goal.center_W = wanted;
    const WholeBodyForces forces = control.forces(state, goal);
    ASSERT_EQ(forces.status, QuadraticStatus::kOptimal);
    const ZeroMomentPoint motion = reactionOf(robot, state, forces), ground = zmpOfContacts(forces.contacts);
    EXPECT_LT((motion.force_W - ground.force_W).norm(), 1e-6);
    EXPECT_LT((motion.p_W - ground.p_W).norm(), 1e-9);
    const Vector3d a = ground.force_W / robot.model.mass() + earthGravity();
    EXPECT_LT((a - wanted).norm(), .05 * wanted.norm()) << a.transpose();
  }
}

TEST(WholeBodyControl, FallsFreelyIfNoFootStands) {
  const Humanoid robot;
  State state = initialState(robot.model);
  state.q = robot.start;
  WholeBodyGoal goal = atRest(robot.model);
  goal.left.stands = goal.right.stands = false;
  goal.center_W = {0, 0, 5};
  const WholeBodyForces forces = WholeBodyControl(robot.model, robot.legs, {}).forces(state, goal);
  ASSERT_EQ(forces.status, QuadraticStatus::kOptimal);
  EXPECT_TRUE(forces.contacts.empty());
  const MomentumRate rate =
      momentumRate(robot.model, forwardKinematics(robot.model, state.q), state.v, forces.a);
  EXPECT_LT((rate.force - robot.model.mass() * earthGravity()).norm(), 1e-6);
}

TEST(WholeBodyControl, SaysWhatItCannotControl) {
  const Humanoid robot;
  const Model& model = robot.model;
  const auto with = [&](const WholeBodyOptions& options) {
    return WholeBodyControl(model, robot.legs, {}, options);
  };
  const std::string start = "whole-body control: ";
  EXPECT_REX_ERROR(with({.friction = 0}), start + "friction: found 0");
  EXPECT_REX_ERROR(with({.standing = -1}), start + "weight of standing feet: found -1");
  EXPECT_REX_ERROR(with({.swinging = 0}), start + "weight of swinging feet: found 0");
  EXPECT_REX_ERROR(with({.center = 0}), start + "weight of the centre of mass: found 0");
  EXPECT_REX_ERROR(with({.angularMomentum = 0}), start + "weight of the angular momentum: found 0");
  EXPECT_REX_ERROR(with({.trunk = 0}), start + "weight of the trunk: found 0");
  EXPECT_REX_ERROR(with({.legs = 0}), start + "weight of legs: found 0");
  EXPECT_REX_ERROR(with({.joints = 0}), start + "weight of joints: found 0");
  EXPECT_REX_ERROR(with({.forces = 0}), start + "weight of forces: found 0");
  EXPECT_REX_ERROR(WholeBodyControl(model, robot.legs, {.length = 0}), start + "length of the sole: found 0");
  EXPECT_REX_ERROR(WholeBodyControl(model, robot.legs, {.width = -1}), start + "width of the sole: found -1");
  Legs legs = robot.legs;
  legs.trunk = model.body("torso");
  EXPECT_REX_ERROR(
      WholeBodyControl(model, legs, {}),
      start + "trunk 'torso': found no free joint that moves it, wanted a robot with a free base");
  SceneSpec withBall = Humanoid::scene();
  BodySpec ball;
  ball.name = "ball";
  ball.mass = 1;
  withBall.bodies.push_back(ball);
  JointSpec joint;
  joint.name = joint.child = "ball";
  joint.parent = "world";
  joint.type = JointType::kFree;
  withBall.joints.push_back(joint);
  const Model two = compile(withBall);
  legs = {.leftFoot = two.body("left_foot"), .rightFoot = two.body("ball"), .trunk = two.body("pelvis")};
  EXPECT_REX_ERROR(WholeBodyControl(two, legs, {}),
                   start + "foot 'ball': found no way from it to the trunk 'pelvis'");

  const WholeBodyControl control(model, robot.legs, {});
  const State state = initialState(model);
  WholeBodyGoal goal;
  EXPECT_REX_ERROR(control.forces(state, goal), start + "goals of joints: found a vector of size 0");
  goal = atRest(model);
  goal.center_W.x() = NAN;
  EXPECT_REX_ERROR(control.forces(state, goal), start + "goal: number 0: found nan");
  goal = atRest(model);
  goal.right.acceleration[5] = INFINITY;
  EXPECT_REX_ERROR(control.forces(state, goal), start + "goal of a foot: number 5: found inf");
  goal = atRest(model);
  goal.joints[3] = NAN;
  EXPECT_REX_ERROR(control.forces(state, goal), start + "goals of joints: number 3: found nan");
}

}  // namespace rex::whole_body_control_test
