#include "dynamics/forward_dynamics.h"

#include <limits>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/allocations.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::forward_dynamics_test {

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& wanted) {
  return (a - wanted).lpNorm<Eigen::Infinity>() / std::max(1., wanted.lpNorm<Eigen::Infinity>());
}

TEST(ForwardDynamics, UndoesInverseDynamicsOnAThousandTrees) {
  Rng rng(31);
  for (int i = 0; i < 1000; ++i) {
    const Model model = randomModel(rng, 2 + i % 29, i % 5 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const Eigen::Vector3d gravity_W = i % 3 == 0 ? Eigen::Vector3d::Zero() : rng.normalVector(3);
    const Eigen::VectorXd a = rng.normalVector(model.nv());
    const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a, gravity_W);
    EXPECT_LE(distance(forwardDynamics(model, at.q, at.v, u, gravity_W), a), 1e-9) << i;
  }
}

TEST(ForwardDynamics, AgreesWithTheMassMatrix) {
  Rng rng(32);
  for (int i = 0; i < 100; ++i) {
    const Model model = randomModel(rng, 2 + i % 29, i % 2 == 0 ? Followers::kSome : Followers::kNone);
    const RandomMotion at(rng, model);
    const Eigen::VectorXd u = 10 * rng.normalVector(model.nv());
    const Eigen::VectorXd wanted = forwardDynamicsByMassMatrix(model, at.q, at.v, u);
    EXPECT_LE(distance(forwardDynamics(model, at.q, at.v, u), wanted), 1e-9) << i;
  }
}

TEST(ForwardDynamics, TakesQuaternionsOfAnyLength) {
  Rng rng(33);
  const Model model = randomModel(rng, 25, Followers::kNone);
  const RandomMotion at(rng, model);
  const Eigen::VectorXd u = rng.normalVector(model.nv()), a = forwardDynamics(model, at.q, at.v, u);
  for (const double length : {1e-160, 1e-3, 1e200}) {
    Eigen::VectorXd q = at.q;
    for (const Link& link : model.links())
      if (link.kind == Link::Kind::kQuaternion) q.segment<4>(link.qIndex) *= length;
    EXPECT_LE(distance(forwardDynamics(model, q, at.v, u), a), 1e-9) << length;
  }
}

SceneSpec freeBrick() {
  SceneSpec spec;
  spec.bodies = {{.name = "brick", .X_WB = {}, .mass = 4}};
  spec.bodies[0].inertia = Eigen::Vector3d(1, 2, 3).asDiagonal();
  spec.joints = {
      {.name = "air", .parent = "world", .child = "brick", .type = JointType::kFree, .X_PF = {}, .X_MC = {}}};
  return spec;
}

// Euler's equations: I dw = torque - w x I w, all in the brick's frame.
TEST(ForwardDynamics, TurnsAFreeBodyAsEulerSays) {
  const Model model = compile(freeBrick());
  Rng rng(34);
  for (int i = 0; i < 10; ++i) {
    const RandomMotion at(rng, model);
    const Eigen::VectorXd u = rng.normalVector(6);
    const Eigen::Vector3d w = at.v.tail<3>(), I(1, 2, 3), torque = u.tail<3>();
    const Eigen::Vector3d gravity_W = rng.normalVector(3), Iw = I.cwiseProduct(w);
    Eigen::VectorXd wanted(6);
    wanted << u.head<3>() / 4 + gravity_W, (torque - w.cross(Iw)).cwiseQuotient(I);
    EXPECT_LE(distance(forwardDynamics(model, at.q, at.v, u, gravity_W), wanted), 1e-14);
  }
}

// A chain of bodies on hinges about z at the origin, each with its mass.
SceneSpec chain(const std::vector<double>& masses) {
  SceneSpec spec;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const std::string number = std::to_string(i);
    const std::string parent = i == 0 ? "world" : spec.bodies.back().name;
    spec.bodies.push_back({.name = "body" + number, .X_WB = {}, .mass = masses[i], .p_BBcm = {0.3, 0.1, 0}});
    spec.joints.push_back(
        {.name = "joint" + number, .parent = parent, .child = "body" + number, .X_PF = {}, .X_MC = {}});
    spec.joints.back().axis = Eigen::Vector3d::UnitZ();
  }
  return spec;
}

// By articulated bodies and by the mass matrix.
void expectSingular(const SceneSpec& spec, const std::string& text) {
  const Model model = compile(spec);
  Rng rng(35);
  const RandomMotion at(rng, model);
  const Eigen::VectorXd u = rng.normalVector(model.nv());
  EXPECT_REX_ERROR(forwardDynamics(model, at.q, at.v, u), text);
  EXPECT_REX_ERROR(forwardDynamicsByMassMatrix(model, at.q, at.v, u), text);
}

TEST(ForwardDynamics, NamesTheBodyThatNeedsMass) {
  expectSingular(chain({1, 0}), "joint 'joint1' moves no mass: wanted some: give body 'body1' a mass");
  expectSingular(chain({0}), "joint 'joint0' moves no mass: wanted some: give body 'body0' a mass");
}

// The first body stays where it is while the second turns about the same axis: what it takes to turn it is
// no more than rounding leaves, now and then a positive number.
TEST(ForwardDynamics, NamesTheBodyThatOthersLeaveBehind) {
  Rng rng(39);
  for (int i = 0; i < 20; ++i) {
    SceneSpec spec = chain({0, 1});
    const Eigen::Vector3d axis = rng.normalVector(3);
    spec.joints[0].axis = spec.joints[1].axis = axis;
    spec.joints[0].X_PF = randomPose(rng);
    spec.joints[0].X_MC = randomPose(rng);
    spec.joints[1].X_PF = spec.joints[0].X_MC.inverse() * Pose{.p = rng.normal() * axis};
    spec.joints[1].X_MC = randomPose(rng);
    expectSingular(spec, "joint 'joint0' moves no mass: wanted some: give body 'body0' a mass");
  }
}

TEST(ForwardDynamics, NamesTheBodyThatNeedsAnInertia) {
  for (const JointType type : {JointType::kHinge, JointType::kBall, JointType::kFree}) {
    SceneSpec spec = chain({1, 1});
    spec.bodies[1].p_BBcm.setZero();
    spec.bodies[1].inertia = Eigen::Matrix3d::Zero();
    spec.joints[1].type = type;
    expectSingular(
        spec, "joint 'joint1' moves no inertia: wanted some about its axis: give body 'body1' an inertia");
  }
}

TEST(ForwardDynamics, NamesTheFollowedJointThatMovesNoMass) {
  SceneSpec spec = chain({1, 0, 0});
  spec.joints[2].mimic = "joint1";
  expectSingular(spec, "joint 'joint1' moves no mass: wanted some: give body 'body1' a mass");
}

// A finger of a millionth of the mass, a hundredth of the size, is light, but no mistake.
TEST(ForwardDynamics, MovesWhatIsVeryLight) {
  SceneSpec spec = chain({1000, 1e-3});
  spec.bodies[1].p_BBcm = {0.003, 0, 0};
  spec.bodies[1].inertia = 1e-9 * Eigen::Matrix3d::Identity();
  const Model model = compile(spec);
  Rng rng(36);
  const RandomMotion at(rng, model);
  const Eigen::Vector2d a(0.3, -0.8);
  const Eigen::VectorXd u = inverseDynamics(model, at.q, at.v, a);
  EXPECT_LE(distance(forwardDynamics(model, at.q, at.v, u), a), 1e-5);
}

TEST(ForwardDynamics, HandsOnWhatIsNoNumber) {
  const Model model = compile(chain({1, 1}));
  const Eigen::VectorXd nan = Eigen::VectorXd::Constant(2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(forwardDynamics(model, nan, nan, nan).array().isNaN().all());
  EXPECT_TRUE(forwardDynamicsByMassMatrix(model, nan, nan, nan).array().isNaN().all());
}

TEST(ForwardDynamics, NamesWrongSizesAndZeroQuaternions) {
  Rng rng(37);
  const Model model = compile(randomScene(rng, 12));
  const RandomMotion at(rng, model);
  const Eigen::VectorXd u = rng.normalVector(model.nv()), two = Eigen::Vector2d(1, 2);
  DynamicsWorkspace workspace;
  Eigen::VectorXd a(2);
  for (const auto& solve : {+[](const Model&m, const VectorArg&q, const VectorArg&v, const VectorArg&given) {
                              return forwardDynamics(m, q, v, given);
                            },
                            +[](const Model&m, const VectorArg&q, const VectorArg&v, const VectorArg&given) {
                              return forwardDynamicsByMassMatrix(m, q, v, given);
                            }}) {
    EXPECT_REX_ERROR(solve(model, two, at.v, u),
                     "joint positions q: found a vector of size 2, wanted size 29");
    EXPECT_REX_ERROR(solve(model, at.q, two, u),
                     "joint velocities v: found a vector of size 2, wanted size 27");
    EXPECT_REX_ERROR(solve(model, at.q, at.v, two),
                     "joint forces u: found a vector of size 2, wanted size 27");
    EXPECT_REX_ERROR(solve(model, Eigen::VectorXd::Zero(model.nq()), at.v, u),
                     "quaternion: found (0, 0, 0, 0), wanted finite numbers, not all zero");
  }
  EXPECT_REX_ERROR(forwardDynamics(model, at.q, at.v, u, earthGravity(), workspace, a),
                   "joint accelerations a: found a vector of size 2, wanted size 27");
}

class ForwardDynamicsOfTrees : public testing::TestWithParam<Followers> {};

// The forces, or the velocities, turn into accelerations where they stand; those of a singular tree stay.
TEST_P(ForwardDynamicsOfTrees, WorksInPlace) {
  Rng rng(40);
  const Model model = randomModel(rng, 30, GetParam());
  const RandomMotion at(rng, model);
  const Eigen::VectorXd u = rng.normalVector(model.nv()), wanted = forwardDynamics(model, at.q, at.v, u);
  DynamicsWorkspace workspace;
  Eigen::VectorXd x = u;
  forwardDynamics(model, at.q, at.v, x, earthGravity(), workspace, x);
  EXPECT_EQ(x, wanted);
  x = at.v;
  forwardDynamics(model, at.q, x, u, earthGravity(), workspace, x);
  EXPECT_EQ(x, wanted);
}

TEST_P(ForwardDynamicsOfTrees, LeavesWhatItCannotSolveForAsItWas) {
  SceneSpec spec = chain({1, 0, 0});
  if (GetParam() == Followers::kSome) spec.joints[2].mimic = "joint1";
  const Model model = compile(spec);
  const Eigen::VectorXd zeros = Eigen::VectorXd::Zero(model.nv());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(model.nv(), 1, 2);
  const Eigen::VectorXd before = x;
  DynamicsWorkspace workspace;
  EXPECT_REX_ERROR(forwardDynamics(model, zeros, zeros, x, earthGravity(), workspace, x), "moves no mass");
  EXPECT_EQ(x, before);
}

#ifndef __SANITIZE_ADDRESS__
TEST_P(ForwardDynamicsOfTrees, AllocatesOnlyAtFirst) {
  Rng rng(38);
  const Model model = randomModel(rng, 30, GetParam());
  const RandomMotion at(rng, model);
  const Eigen::VectorXd u = rng.normalVector(model.nv());
  Eigen::VectorXd a(model.nv());
  DynamicsWorkspace workspace;
  const long before = allocations();
  forwardDynamics(model, at.q, at.v, u, earthGravity(), workspace, a);
  const long first = allocations();
  forwardDynamics(model, at.q, at.v, u, earthGravity(), workspace, a);
  EXPECT_GT(first, before);
  EXPECT_EQ(allocations(), first);
}
#endif

INSTANTIATE_TEST_SUITE_P(PlainAndMimicking, ForwardDynamicsOfTrees,
                         testing::Values(Followers::kNone, Followers::kSome));

}  // namespace rex::forward_dynamics_test
