#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "dynamics/inverse_dynamics.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"
#include "scene/state.h"
#include "support/expect_error.h"
#include "support/random_motion.h"

namespace rex::wrench_test {

std::vector<Wrench> randomWrenches(Rng& rng, const Model& model, int count) {
  std::vector<Wrench> wrenches;
  for (int i = 0; i < count; ++i)
    wrenches.push_back({.body = BodyId{rng.index(static_cast<int>(model.bodies().size()))},
                        .p_BQ = rng.normalVector(3),
                        .force_W = rng.normalVector(3),
                        .torque_W = rng.normalVector(3)});
  return wrenches;
}

TEST(WrenchForces, AreTheTransposedJacobiansTimesTheWrenches) {
  Rng rng(331);
  for (int i = 0; i < 20; ++i) {
    const Model model = randomModel(rng, 2 + 2 * i, Followers::kSome);
    const BodyPoses poses = forwardKinematics(model, randomPositions(rng, model.nq()));
    const std::vector<Wrench> wrenches = randomWrenches(rng, model, 5);
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(model.nv());
    for (const Wrench& w : wrenches)
      wanted += positionJacobian(model, poses, w.body, w.p_BQ).transpose() * w.force_W +
                angularJacobian(model, poses, w.body).transpose() * w.torque_W;
    EXPECT_LE((wrenchForces(model, poses, wrenches) - wanted).norm(), 1e-12 * wanted.norm() + 1e-300);
  }
}

// Velocities by differences of poses, not by Jacobians.
TEST(WrenchForces, DoTheWorkOfTheWrenches) {
  Rng rng(332);
  const Model model = randomModel(rng, 40, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq()), v = rng.normalVector(model.nv());
  const BodyPoses poses = forwardKinematics(model, q);
  const std::vector<Wrench> wrenches = randomWrenches(rng, model, 20);
  const VectorFunction work = [&](const Eigen::VectorXd& time) {
    const BodyPoses at = forwardKinematics(model, integrate(model, q, time[0] * v));
    double sum = 0;
    for (const Wrench& w : wrenches)
      sum += w.force_W.dot(at[w.body] * w.p_BQ) +
             w.torque_W.dot(logSO3(at[w.body].R * poses[w.body].R.transpose()));
    return Eigen::VectorXd::Constant(1, sum);
  };
  const double power = numericJacobian(work, Eigen::VectorXd::Zero(1))(0, 0);
  EXPECT_NEAR(wrenchForces(model, poses, wrenches).dot(v), power, 1e-8 * std::abs(power));
}

// Weight as wrenches on centres of mass is what gravity does.
TEST(WrenchForces, OfTheWeightsBalanceGravity) {
  Rng rng(333);
  const Model model = randomModel(rng, 40, Followers::kSome);
  const Eigen::VectorXd q = randomPositions(rng, model.nq());
  std::vector<Wrench> weights;
  for (int b = 1; b < static_cast<int>(model.bodies().size()); ++b)
    weights.push_back({.body = BodyId{b},
                       .p_BQ = model[BodyId{b}].p_BBcm,
                       .force_W = model[BodyId{b}].mass * earthGravity()});
  const Eigen::VectorXd G = gravityForces(model, q);
  EXPECT_LE((wrenchForces(model, forwardKinematics(model, q), weights) + G).norm(), 1e-12 * G.norm());
}

TEST(WrenchForces, OfNoneAndOnTheWorldAreZero) {
  Rng rng(334);
  const Model model = randomModel(rng, 13, Followers::kSome);
  const BodyPoses poses = forwardKinematics(model, randomPositions(rng, model.nq()));
  EXPECT_EQ(wrenchForces(model, poses, {}), Eigen::VectorXd::Zero(model.nv()));
  const Wrench onWorld{.force_W = {1, 2, 3}, .torque_W = {4, 5, 6}};
  EXPECT_EQ(wrenchForces(model, poses, {&onWorld, 1}), Eigen::VectorXd::Zero(model.nv()));
}

TEST(WrenchForces, NamesWrongSizes) {
  Rng rng(335);
  const Model model = compile(randomScene(rng, 3));
  DynamicsWorkspace workspace;
  Eigen::VectorXd five(5);
  EXPECT_REX_ERROR(
      wrenchForces(model, forwardKinematics(model, Eigen::Vector2d::Zero()), {}, workspace, five),
      "joint forces u: found a vector of size 5, wanted size 2");
}

}  // namespace rex::wrench_test
