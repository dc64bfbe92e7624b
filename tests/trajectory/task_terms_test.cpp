#include <cmath>

#include <gtest/gtest.h>

#include "kinematics/jacobians.h"
#include "kinematics/task_maps.h"
#include "support/expect_error.h"
#include "support/planar_chain.h"
#include "trajectory/motion_terms.h"
#include "trajectory/term_check.h"
#include "trajectory/trajectory_optimizer.h"

namespace rex::task_terms_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Task tipTask(const Model& model, const VectorXd& target = {}) {
  return {
      .name = "tip", .map = positionTask(model.body("link2"), {1, 0, 0}), .target = target, .precision = 4};
}

MatrixXd window(int order) {
  const MatrixXd X =
      (MatrixXd(3, 4) << 0.05, 0.1, 0.2, 0.25, -0.3, -0.4, -0.2, -0.1, 0.8, 0.7, 0.7, 0.6).finished();
  return X.rightCols(order + 1);
}

TEST(TaskTerms, HaveTheirDerivatives) {
  const Model model = compile(swingScene());
  for (int order = 0; order <= 3; ++order) {
    const JacobianCheck check =
        checkTerm(taskTerm(model, tipTask(model, Vector3d(1, 2, 3)), order), window(order), 0.1);
    EXPECT_TRUE(check.ok) << "k = " << order << ": " << check.message;
  }
}

TEST(TaskTerms, AreDifferencesOfTheMap) {
  const Model model = compile(swingScene());
  const auto tip = [&](const VectorXd& q) -> VectorXd {
    return position(forwardKinematics(model, q), model.body("link2"), {1, 0, 0});
  };
  const MatrixXd X = window(3);
  const Vector3d target(1, 2, 3);
  const double tau = 0.1;
  const VectorXd y[4] = {tip(X.col(3)), tip(X.col(2)), tip(X.col(1)), tip(X.col(0))};
  const VectorXd wanted[4] = {
      2 * (y[0] - target), 2 * std::sqrt(tau) * ((y[0] - y[1]) / tau - target),
      2 * std::sqrt(tau) * ((y[0] - 2 * y[1] + y[2]) / (tau * tau) - target),
      2 * std::sqrt(tau) * ((y[0] - 3 * y[1] + 3 * y[2] - y[3]) / (tau * tau * tau) - target)};
  for (int order = 0; order <= 3; ++order) {
    const FunctionValue value = valueOf(taskTerm(model, tipTask(model, target), order), window(order), tau);
    EXPECT_LT((value.y - wanted[order]).cwiseAbs().maxCoeff(), 1e-10) << "k = " << order;
  }
}

// The arm reaches for a point that it can touch, at rest, along a way with little acceleration.
TEST(TaskTerms, BringAnArmToItsGoal) {
  SceneSpec spec = swingScene();
  for (JointSpec& joint : spec.joints) {
    joint.lower = VectorXd::Constant(1, -0.2);
    joint.upper = VectorXd::Constant(1, 1.04);
  }
  const Model model = compile(spec);
  const int T = 25;
  const VectorXd q0 = Vector3d(0.1, 0.1, 0.1);
  const Vector3d goal(0.5, 0, 2);
  const TrajectoryProblem problem({accelerationTerm(), jointLimitsTerm(model),
                                   as(TermKind::kEquality, at(taskTerm(model, tipTask(model, goal)), T - 1)),
                                   as(TermKind::kEquality, at(velocityTerm(), T - 1))},
                                  q0.replicate(1, 2), T, 1. / T);
  const TrajectoryResult result = optimizeTrajectory(problem, q0.replicate(1, T));
  EXPECT_EQ(result.solution.status, ConstrainedStatus::kSolved) << result.solution.message;
  const VectorXd end = result.X.col(T - 1);
  EXPECT_LT((position(forwardKinematics(model, end), model.body("link2"), {1, 0, 0}) - goal).norm(), 1e-7);
  EXPECT_LT(result.X.maxCoeff(), 1.04 + 1e-7);
  EXPECT_GT(result.X.maxCoeff(), 1.04 - 1e-3);  // the limit holds it back
}

TEST(TaskTerms, SayWhatIsWrong) {
  const Model model = compile(swingScene());
  Task task = tipTask(model, Eigen::Vector2d(1, 2));
  EXPECT_REX_ERROR(valueOf(taskTerm(model, task), window(0), 1),
                   "task 'tip': target: found a vector of size 2, wanted size 3");
  EXPECT_REX_ERROR(taskTerm(model, task, 4), "task 'tip': order: found 4, wanted 0, 1, 2 or 3");
  EXPECT_REX_ERROR(valueOf(taskTerm(model, tipTask(model)), MatrixXd::Zero(2, 1), 1),
                   "configurations of a trajectory: found a vector of size 2, wanted size 3");
  task.precision = 0;
  EXPECT_REX_ERROR(taskTerm(model, task), "task 'tip': precision: found 0, wanted a positive, finite number");
  task.map = {};
  EXPECT_REX_ERROR(taskTerm(model, task), "task 'tip': map: found none, wanted a function");
  SceneSpec spec = swingScene();
  spec.joints[1].type = JointType::kBall;
  EXPECT_REX_ERROR(taskTerm(compile(spec), tipTask(model)),
                   "model of a trajectory: found joints with quaternions, wanted hinges, sliders");
  EXPECT_REX_ERROR(jointLimitsTerm(compile(spec)), "model of a trajectory: found joints with quaternions");
}

}  // namespace rex::task_terms_test
