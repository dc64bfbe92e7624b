#include "control/robot_steps.h"

#include <gtest/gtest.h>

#include "base/derivative_check.h"
#include "control/ilqr.h"
#include "dynamics/forward_dynamics.h"
#include "support/expect_error.h"
#include "support/planar_chain.h"
#include "support/random_scene.h"

namespace rex::robot_steps_test {

using Eigen::VectorXd;

Eigen::VectorXd stateOf(const VectorXd& q, const VectorXd& v) {
  VectorXd x(q.size() + v.size());
  x << q, v;
  return x;
}

TEST(RobotSteps, AreStepsOfEuler) {
  const Model model = compile(swingScene());
  const Eigen::Vector3d q(0.2, -0.5, 1.1), v(1, 2, -1), u(3, -2, 1);
  RobotSteps steps(model, 0.1, 2);
  VectorXd atQ = q, atV = v;
  for (int i = 0; i < 2; ++i) {
    atV += 0.05 * forwardDynamics(model, atQ, atV, u);
    atQ += 0.05 * atV;
  }
  EXPECT_EQ(steps.next(stateOf(q, v), u), stateOf(atQ, atV));
}

TEST(RobotSteps, HaveTheDerivativesOfDifferences) {
  Rng rng(501);
  for (int i = 0; i < 30; ++i) {
    SceneSpec spec = randomScene(rng, 2 + i % 9);
    for (JointSpec& joint : spec.joints)
      if (joint.type == JointType::kBall || joint.type == JointType::kFree)
        joint.type = JointType::kUniversal;
    const Model model = compile(spec);
    const VectorXd x = rng.normalVector(2 * model.nv()), u = rng.normalVector(model.nv());
    RobotSteps steps(model, 0.02, 1 + i % 3);
    const MotionJacobians J = steps.derivative(x, u);
    const JacobianCheck byX =
        checkJacobian([&](const VectorXd& moved) { return steps.next(moved, u); }, J.A, x, 1e-8);
    const JacobianCheck byU =
        checkJacobian([&](const VectorXd& moved) { return steps.next(x, moved); }, J.B, u, 1e-8);
    EXPECT_TRUE(byX.ok) << byX.message;
    EXPECT_TRUE(byU.ok) << byU.message;
  }
}

// The three links swing from hanging to a posture held against gravity.
TEST(RobotSteps, LeadIlqrToThePlanOfDifferences) {
  const Model model = compile(swingScene());
  RobotSteps steps(model, 0.04);
  const VectorXd goal = stateOf(Eigen::Vector3d(-1, 0.5, 0.5), Eigen::Vector3d::Zero());
  ControlProblem problem{
      .next = [&](const VectorXd& x, const VectorXd& u) { return steps.next(x, u); },
      .stage = [](const VectorXd&, const VectorXd& u, int) -> VectorXd { return 0.01 * u; },
      .final = [&](const VectorXd& x) -> VectorXd { return 10 * (x - goal); },
      .start = stateOf(Eigen::Vector3d(-1.57, 0, 0), Eigen::Vector3d::Zero())};
  const Eigen::MatrixXd U = Eigen::MatrixXd::Zero(3, 25);
  const IlqrResult numeric = ilqr(problem, U);
  problem.derivative = [&](const VectorXd& x, const VectorXd& u) { return steps.derivative(x, u); };
  const IlqrResult exact = ilqr(problem, U);
  EXPECT_EQ(exact.status, IlqrStatus::kConverged) << exact.message;
  EXPECT_NEAR(exact.cost, numeric.cost, 1e-7 * numeric.cost);
  EXPECT_LE((exact.X.col(25) - goal).norm(), 0.1);
}

TEST(RobotSteps, NameWhatIsWrong) {
  Rng rng(502);
  const Model tree = compile(randomScene(rng, 12)), chain = compile(swingScene());
  EXPECT_REX_ERROR(RobotSteps(tree, 0.1), "found a joint with a quaternion");
  EXPECT_REX_ERROR(RobotSteps(chain, 0), "step of a robot: found 0");
  EXPECT_REX_ERROR(RobotSteps(chain, 0.1, 0), "parts of a step: found 0, wanted at least 1");
  RobotSteps steps(chain, 0.1);
  const VectorXd three = VectorXd::Zero(3), six = VectorXd::Zero(6);
  EXPECT_REX_ERROR(steps.next(three, three), "state x: found a vector of size 3, wanted size 6");
  EXPECT_REX_ERROR(steps.derivative(three, three), "state x: found a vector of size 3, wanted size 6");
  EXPECT_REX_ERROR(steps.next(six, six), "joint forces u: found a vector of size 6, wanted size 3");
}

}  // namespace rex::robot_steps_test
