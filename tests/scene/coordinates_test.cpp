#include <gtest/gtest.h>

#include "kinematics/forward_kinematics.h"
#include "scene/state.h"
#include "support/random_motion.h"

namespace rex::coordinates_test {

// Where the child of a joint is, seen from its parent.
Pose across(const Joint& joint, const BodyPoses& poses) {
  return poses[joint.parent].inverse() * poses[joint.child];
}

// The joint that a coordinate belongs to is the one that it moves, of all that follow no other.
void expectToMove(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& moved,
                  const Joint& wanted, const std::string& what) {
  const BodyPoses before = forwardKinematics(model, q), after = forwardKinematics(model, moved);
  for (const Joint& joint : model.joints()) {
    if (joint.mimics) continue;
    const Pose X = across(joint, before), Y = across(joint, after);
    EXPECT_EQ((X.R - Y.R).norm() + (X.p - Y.p).norm() > 1e-6, joint.name == wanted.name) << what;
  }
}

TEST(JointOf, ACoordinateIsTheOneThatItMoves) {
  Rng rng(71);
  const Model model = randomModel(rng, 30, Followers::kSome);
  const RandomMotion at(rng, model);
  for (int i = 0; i < model.nq(); ++i) {
    Eigen::VectorXd q = at.q;
    q[i] += 0.1;
    expectToMove(model, at.q, q, jointOfPosition(model, i), "q " + std::to_string(i));
  }
  for (int i = 0; i < model.nv(); ++i) {
    const Eigen::VectorXd q = integrate(model, at.q, 0.1 * Eigen::VectorXd::Unit(model.nv(), i));
    expectToMove(model, at.q, q, jointOfVelocity(model, i), "v " + std::to_string(i));
  }
}

}  // namespace rex::coordinates_test
