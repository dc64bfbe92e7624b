#include "scene/state.h"

#include <gtest/gtest.h>

#include "geometry/rotation.h"
#include "support/expect_error.h"
#include "support/random_scene.h"

namespace rex::state_test {

TEST(JointMotion, IsInvertedByJointCoordinates) {
  Rng rng(1);
  for (const JointType type : kAllJointTypes) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d axis = rng.normalVector(3);
      Eigen::VectorXd q = rng.uniformVector(positionCount(type), -1.5, 1.5);
      const Pose X = jointMotion(type, axis, 0.3, q.data());
      const Eigen::VectorXd back = jointCoordinates(type, axis, X);
      EXPECT_TRUE(isApprox(jointMotion(type, axis, 0.3, back.data()), X, 1e-13));
      if (positionCount(type) == velocityCount(type)) {
        EXPECT_LT((back - q).norm(), 1e-13);
      }
    }
  }
}

TEST(Integrate, AndDifferenceInvertEachOther) {
  Rng rng(2);
  const Model model = compile(randomScene(rng, 31));
  for (const double scale : {0., 1e-8, 0.5}) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd q0 = integrate(model, model.initialPositions(), rng.normalVector(model.nv()));
      const Eigen::VectorXd v = scale * rng.normalVector(model.nv());
      const Eigen::VectorXd q1 = integrate(model, q0, v);
      EXPECT_LT((difference(model, q0, q1) - v).cwiseAbs().maxCoeff(), 1e-14 + 1e-13 * scale);
      EXPECT_LT(difference(model, q1, q1).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(Integrate, TurnsTheMovedFrameOfABall) {
  SceneSpec spec;
  spec.bodies = {{.name = "a", .X_WB = {}}, {.name = "b", .X_WB = {}}};
  spec.joints = {
      {.name = "j", .parent = "a", .child = "b", .type = JointType::kBall, .X_PF = {}, .X_MC = {}}};
  const Model model = compile(spec);
  const Eigen::VectorXd q =
      integrate(model, quaternionFromRotation(expSO3({0.3, 0, 0})), Eigen::Vector3d(0, 0.4, 0));
  EXPECT_LT((rotationFromQuaternion(q) - expSO3({0.3, 0, 0}) * expSO3({0, 0.4, 0})).norm(), 1e-15);
}

TEST(Integrate, NamesWrongSizes) {
  Rng rng(3);
  const Model model = compile(randomScene(rng, 3));  // hinge and slider
  const Eigen::VectorXd two = Eigen::VectorXd::Zero(2), three = Eigen::VectorXd::Zero(3);
  EXPECT_REX_ERROR(integrate(model, three, two),
                   "joint positions q: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(integrate(model, two, three),
                   "joint velocities v: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(difference(model, three, two),
                   "joint positions q0: found a vector of size 3, wanted size 2");
  EXPECT_REX_ERROR(difference(model, two, three),
                   "joint positions q1: found a vector of size 3, wanted size 2");
}

TEST(InitialState, IsAtRestInTheFilePosture) {
  Rng rng(4);
  const Model model = compile(randomScene(rng, 12));
  const State state = initialState(model);
  EXPECT_EQ(state.q, model.initialPositions());
  EXPECT_EQ(state.v, Eigen::VectorXd::Zero(model.nv()));
  EXPECT_EQ(state.time, 0);
}

}  // namespace rex::state_test
