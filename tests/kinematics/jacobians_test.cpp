#include "kinematics/jacobians.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "geometry/rotation.h"
#include "kinematics/center_of_mass.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::jacobians_test {

BodyId lastBody(const Model& model) { return BodyId{static_cast<int>(model.bodies().size()) - 1}; }

// Compares J with differences along v, which for quaternions is not the same as along q.
void expectDerivative(const Model& model, const Eigen::VectorXd& q, const Eigen::MatrixXd& J,
                      const std::function<Eigen::VectorXd(const BodyPoses&)>& f) {
  const VectorFunction alongV = [&](const Eigen::VectorXd& v) {
    return f(forwardKinematics(model, integrate(model, q, v)));
  };
  const JacobianCheck check = checkJacobian(alongV, J, Eigen::VectorXd::Zero(model.nv()), 1e-8);
  EXPECT_TRUE(check.ok) << check.message;
}

class JacobianOfRandomTree : public testing::TestWithParam<double> {};

TEST_P(JacobianOfRandomTree, AgreesWithDifferences) {
  Rng rng(21);
  for (int i = 0; i < 10; ++i) {
    const Model model = compile(randomScene(rng, 12 + i));
    const Eigen::VectorXd q =
        integrate(model, model.initialPositions(), GetParam() * rng.normalVector(model.nv()));
    const BodyPoses poses = forwardKinematics(model, q);
    const Eigen::Vector3d p_BQ = rng.normalVector(3);
    for (int b = 0; b < static_cast<int>(model.bodies().size()); ++b) {
      const BodyId body{b};
      expectDerivative(model, q, positionJacobian(model, poses, body, p_BQ),
                       [&](const BodyPoses& at) { return position(at, body, p_BQ); });
      expectDerivative(model, q, directionJacobian(model, poses, body, p_BQ),
                       [&](const BodyPoses& at) { return direction(at, body, p_BQ); });
      expectDerivative(model, q, angularJacobian(model, poses, body),
                       [&](const BodyPoses& at) { return logSO3(at[body].R * poses[body].R.transpose()); });
    }
    expectDerivative(model, q, centerOfMassJacobian(model, poses),
                     [&](const BodyPoses& at) { return centerOfMass(model, at); });
  }
}

INSTANTIATE_TEST_SUITE_P(AtZeroTinyAndRandom, JacobianOfRandomTree, testing::Values(0., 1e-8, 1.));

TEST(Jacobian, AddsUpMimickingJoints) {
  Rng rng(22);
  SceneSpec spec;
  for (const char* name : {"a", "b", "c"}) spec.bodies.push_back({.name = name, .X_WB = randomPose(rng)});
  spec.joints.push_back(
      {.name = "first", .parent = "a", .child = "b", .X_PF = randomPose(rng), .X_MC = randomPose(rng)});
  spec.joints.push_back({.name = "second",
                         .parent = "b",
                         .child = "c",
                         .X_PF = randomPose(rng),
                         .X_MC = randomPose(rng),
                         .mimic = "first"});
  const Model model = compile(spec);
  ASSERT_EQ(model.nv(), 1);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.7);
  const BodyPoses poses = forwardKinematics(model, q);
  const BodyId tip = model.body("c");
  expectDerivative(model, q, positionJacobian(model, poses, tip, {1, 2, 3}), [&](const BodyPoses& at) {
    return position(at, tip, {1, 2, 3});
  });
}

// A hinge at b makes c slide 0.4 m/rad times as far as b turns, 0.1 m ahead, and d screw backwards.
TEST(ForwardKinematics, FollowsRatioAndOffsetOfMimickingJoints) {
  Rng rng(25);
  SceneSpec spec;
  for (const char* name : {"a", "b", "c", "d"})
    spec.bodies.push_back({.name = name, .X_WB = randomPose(rng)});
  spec.joints.push_back(
      {.name = "first", .parent = "a", .child = "b", .X_PF = randomPose(rng), .X_MC = randomPose(rng)});
  spec.joints.push_back({.name = "second",
                         .parent = "b",
                         .child = "c",
                         .type = JointType::kSlider,
                         .X_PF = randomPose(rng),
                         .X_MC = {},
                         .axis = {0, 0, 2},
                         .mimic = "first",
                         .mimicRatio = 0.4,
                         .mimicOffset = 0.1});
  spec.joints.push_back({.name = "third",
                         .parent = "c",
                         .child = "d",
                         .type = JointType::kScrew,
                         .X_PF = {},
                         .X_MC = randomPose(rng),
                         .pitch = 0.25,
                         .mimic = "first",
                         .mimicRatio = -2});
  const Model model = compile(spec);
  ASSERT_EQ(model.nv(), 1);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(1, 0.7);
  const BodyPoses poses = forwardKinematics(model, q);
  const BodyId b = model.body("b"), c = model.body("c"), d = model.body("d");
  EXPECT_TRUE(isApprox(poses[c], poses[b] * spec.joints[1].X_PF * translation(0, 0, 0.4 * 0.7 + 0.1), 1e-14));
  const Pose turned = rotation(-1.4, Eigen::Vector3d::UnitX());
  const Pose moved = translation(-1.4 * 0.25 / (2 * std::numbers::pi), 0, 0);
  EXPECT_TRUE(isApprox(poses[d], poses[c] * moved * turned * spec.joints[2].X_MC, 1e-14));
  expectDerivative(model, q, positionJacobian(model, poses, d, {1, 2, 3}), [&](const BodyPoses& at) {
    return position(at, d, {1, 2, 3});
  });
}

TEST(ForwardKinematics, NormalisesQuaternions) {
  Rng rng(23);
  const Model model = compile(randomScene(rng, 12));
  Eigen::VectorXd q = randomPositions(rng, model.nq());
  const BodyPoses poses = forwardKinematics(model, q);
  for (const Joint& joint : model.joints()) {
    if (joint.type == JointType::kBall) q.segment<4>(joint.qIndex) *= -3;
  }
  EXPECT_TRUE(isApprox(forwardKinematics(model, q)[lastBody(model)], poses[lastBody(model)], 1e-13));
}

TEST(ForwardKinematics, NamesWrongSizes) {
  Rng rng(24);
  const Model model = compile(randomScene(rng, 3));
  EXPECT_REX_ERROR(forwardKinematics(model, Eigen::VectorXd::Zero(5)),
                   "joint positions q: found a vector of size 5, wanted size 2");
}

TEST(CenterOfMass, NeedsAMass) {
  SceneSpec spec;
  spec.name = "ghost.ors";
  spec.bodies = {{.name = "a", .X_WB = {}}};
  const Model model = compile(spec);
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  EXPECT_REX_ERROR(centerOfMass(model, poses),
                   "centre of mass of scene 'ghost.ors': found no body with a mass");
  EXPECT_REX_ERROR(centerOfMassJacobian(model, poses),
                   "centre of mass of scene 'ghost.ors': found no body with a mass");
}

}  // namespace rex::jacobians_test
