// Chapter 8: Nonlinear model-predictive control. An arm reaches for targets with motors that are too weak to
// hold it stretched out. Thirty times a second iLQR improves the plan of the last time, within the strength
// of the motors; dots show where it plans its hand to be.
// Slides: 8:12, 8:13
// Formula: min Σ c(x_t, u_t) subject to x_t+1 = f(x_t, u_t), |u| <= u_max: linearised again and again
// Try: An arm with weak motors swings its hand to targets. Plan 5 "steps" instead of 30: it oscillates for
// seconds.
#include "control/ilqr.h"
#include "control/robot_steps.h"
#include "course/car_view.h"
#include "course/course.h"
#include "course/live_view.h"
#include "kinematics/jacobians.h"
#include "render/picture.h"

using namespace rex;

int main() {
  constexpr double kStep = 1. / 30;
  Simulator S("arm3");
  S.setJointAngles(Eigen::Vector3d(2.6, 0.3, 0.3));
  const Model model = S.model();
  const BodyId end = model.body("eff");
  const auto handAt = [&](const Eigen::VectorXd& x) -> Eigen::Vector3d {
    return forwardKinematics(model, x.head(3))[end] * Eigen::Vector3d(0, 0, 0.15);
  };
  const auto handJacobian = [&](const Eigen::VectorXd& x) {
    return positionJacobian(model, forwardKinematics(model, x.head(3)), end, {0, 0, 0.15});
  };
  Eigen::Array3d strength;
  const auto torques = [&](const Eigen::VectorXd& u) -> Eigen::VectorXd {
    return strength * (u.array() / strength).tanh();
  };
  Eigen::Vector3d target;
  // The motion in semi-implicit Euler steps; the arm itself moves by Runge-Kutta steps.
  RobotSteps steps(model, kStep, 2);
  ControlProblem problem{
      .next = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& u) { return steps.next(x, torques(u)); },
      .stage = [&](const Eigen::VectorXd& x, const Eigen::VectorXd& u, int) -> Eigen::VectorXd {
        Eigen::VectorXd e(9);
        e << 2 * (handAt(x) - target), 0.1 * x.tail(3), 0.02 * u;
        return e;
      },
      .final = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        Eigen::VectorXd e(6);
        e << 20 * (handAt(x) - target), 2 * x.tail(3);
        return e;
      },
      .start = {},
      .derivative =
          [&](const Eigen::VectorXd& x, const Eigen::VectorXd& u) {
            MotionJacobians J = steps.derivative(x, torques(u));
            J.B *= (1 - (u.array() / strength).tanh().square()).matrix().asDiagonal();
            return J;
          },
      .stageDerivative =
          [&](const Eigen::VectorXd& x, const Eigen::VectorXd&, int) {
            MotionJacobians J{Eigen::MatrixXd::Zero(9, 6), Eigen::MatrixXd::Zero(9, 3)};
            J.A.topLeftCorner(3, 3) = 2 * handJacobian(x);
            J.A.block(3, 3, 3, 3).diagonal().setConstant(0.1);
            J.B.bottomRows(3).diagonal().setConstant(0.02);
            return J;
          },
      .finalDerivative =
          [&](const Eigen::VectorXd& x) {
            Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, 6);
            J.topLeftCorner(3, 3) = 20 * handJacobian(x);
            J.bottomRightCorner(3, 3).diagonal().setConstant(2);
            return J;
          }};
  LiveView view("reaching");
  view.lookFrom({2.5, -0.4, 0.3});
  IlqrResult plan;
  for (int t = 0; t < 480 || view.isWatched(); ++t) {
    const int horizon = static_cast<int>(view.slider("steps planned", 3, 45, 30));
    strength = view.slider("strength of the shoulder [N m]", 4, 20, 9) * Eigen::Array3d(1, 0.5, 0.17);
    if (view.button("push"))
      S.setJointAnglesAndVels(S.getJointAngles(), S.getJointVels() + Eigen::Vector3d(4, 0, 0));
    target = view.handle("target", {0, -0.4, 1.4});
    target.x() = 0;
    if (t % 240 >= 120) target.y() *= -1;
    problem.start.resize(6);
    problem.start << S.getJointAngles(), S.getJointVels();
    const bool isNew = plan.U.cols() != horizon;
    plan = ilqr(problem, isNew ? Eigen::MatrixXd::Constant(3, horizon, 0.1) : followedPlan(problem, plan),
                {.maxIterations = isNew ? 20 : 3});
    const Eigen::VectorXd u = torques(plan.U.col(0));
    for (int i = 0; i < 10; ++i) S.stepDynamics(u, kStep / 10);

    Picture picture = scenePicture(model, forwardKinematics(model, S.getJointAngles()));
    PointSet dots{.color = kEstimateColor, .size = 7};
    for (const auto& x : plan.X.colwise()) dots.points.push_back(handAt(x) + Eigen::Vector3d(0.06, 0, 0));
    picture.pointSets.push_back(dots);
    picture.solids.push_back({{.type = ShapeType::kSphere, .radius = 0.03},
                              translation(0, target.y(), target.z()),
                              kDeadReckoningColor,
                              "target"});
    view.plot("hand to target [m]", t * kStep, (handAt(problem.start) - target).norm());
    view.plot("torque of the shoulder [N m]", t * kStep, u[0]);
    view.show(picture);
  }
}
