// Chapter 8: Model-predictive control. A cart with a pole goes back and forth between two targets near the
// ends of its rail. Every thirtieth of a second it plans the next steps within the limits of its motor and of
// the rail; dots show where it plans to be. LQR knows no limits: cut off, it falls.
// Slides: 8:12, 8:13
// Formula: min Σ xᵀQx + uᵀRu over the next steps, subject to x_t+1 = A x_t + B u_t, |u| <= u_max, |p| <=
// p_max
// Try: A cart with a weak motor avoids its walls; dots show the plan. Plan 10 "steps" instead of 45, or
// press "MPC or LQR": it falls.
#include <algorithm>
#include <limits>

#include "control/predictive_controller.h"
#include "course/car_view.h"
#include "course/cart_pole_pictures.h"
#include "course/course.h"
#include "course/live_view.h"
#include "render/picture.h"
#include "systems/cart_pole.h"

using namespace rex;

int main() {
  constexpr double kStep = 1. / 30, kNone = std::numeric_limits<double>::infinity();
  CartPole plant(0, {.tau = kStep / 10, .noise = 0});
  plant.x = Eigen::Vector4d(-1, 0, 0, 0);
  LiveView view("mpc");
  view.lookFrom({0.2, -2, 0.35});
  const LinearizedPlant upright = plant.getLinearization();
  const LinearSystem held = discretized({.A = upright.A, .B = upright.B}, kStep);
  const Eigen::MatrixXd Q = Eigen::Vector4d(10, 0, 1, 0).asDiagonal(),
                        R = Eigen::MatrixXd::Constant(1, 1, .01);
  const RiccatiResult regulator = lqr(held, Q, R);
  PredictedMotion last;
  int before = 0;
  bool planning = true;
  for (int t = 0; t < 480 || view.isWatched(); ++t) {
    const int horizon = static_cast<int>(view.slider("steps planned", 1, 60, 45));
    const double force = view.slider("largest force [N]", 2, 20, 6);
    const double end = view.slider("end of the rail [m]", 1, 2, 1.1);
    if (view.button("MPC or LQR")) planning = !planning;
    if (view.button("push")) plant.x[3] += .5;
    const double target = t % 240 < 120 ? 1 : -1;
    double u = -regulator.K.row(0).dot(plant.x - Eigen::Vector4d(target, 0, 0, 0));
    PredictedMotion plan;
    if (planning) {
      const PredictiveController controller(held, {.Q = Q,
                                                   .R = R,
                                                   .horizon = horizon,
                                                   .uMin = Eigen::VectorXd::Constant(1, -force),
                                                   .uMax = Eigen::VectorXd::Constant(1, force),
                                                   .xMin = Eigen::Vector4d(-end, -kNone, -kNone, -kNone),
                                                   .xMax = Eigen::Vector4d(end, kNone, kNone, kNone),
                                                   .slackWeight = 1000});
      const RestPoint goal{.x = Eigen::Vector4d(target, 0, 0, 0), .u = Eigen::VectorXd::Zero(1)};
      plan = controller.plan(plant.x, goal, horizon == before ? &last : nullptr);
      if (plan.status == QuadraticStatus::kOptimal) u = plan.U(0, 0);
    }
    before = planning ? horizon : 0;
    u = std::clamp(u, -force, force);
    for (int i = 0; i < 10; ++i) plant.step(u);
    std::string text = planning ? plan.message : "LQR, cut off";
    if (std::abs(plant.x[2]) > 1.5 || std::abs(plant.x[0]) > 6) {
      plant.x = Eigen::Vector4d(target, 0, 0, 0);
      text = "it fell, or left the rail, and was set upright again";
    }
    Picture picture = cartPolePicture(CartPoleView{.x = plant.x, .u = u, .caption = text});
    PointSet dots{.color = kEstimateColor, .size = 8};
    for (Eigen::Index k = 0; k < plan.X.cols(); k += 3) dots.points.push_back({plan.X(0, k), -.3, 1});
    if (!dots.points.empty()) picture.pointSets.push_back(dots);
    picture.pointSets.push_back({.points = {{target, -.3, .8}}, .color = kDeadReckoningColor, .size = 18});
    for (const double wall : {-end - .5, end + .5})
      picture.solids.push_back({{.extent = {.04, .6, .6}}, translation(wall, 0, 1.1), kTruthColor, "wall"});
    view.plot("position [m]", t * kStep, plant.x[0]);
    view.plot("angle [rad]", t * kStep, plant.x[2]);
    view.plot("force [N]", t * kStep, u);
    view.show(picture);
    last = plan;
  }
}
