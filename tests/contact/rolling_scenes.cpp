// Balls and wheels.
#include <cmath>

#include "contact/contact_scenes.h"
#include "geometry/rotation.h"

namespace rex::contact {
namespace {

using Eigen::Vector3d;

constexpr double kRadius = 0.1, kMass = 2;

Model ballOnSlope(double angle) {
  const Pose X_WG = rotation(angle, Vector3d::UnitY());
  SceneSpec spec;
  addGround(spec, X_WG);
  addLoose(spec, "ball", kMass, ballShape(kRadius), X_WG * translation(0, 0, kRadius));
  return compile(spec);
}

double rollingWay(const Engine& engine) {
  const Model model = ballOnSlope(0.3);
  const auto world = engine(model, {.friction = 0.6});
  world->run(1);
  return (world->state().q - model.initialPositions()).head<3>().norm();
}

double spinOfSlippingBall(const Engine& engine) {
  const auto world = engine(ballOnSlope(0.8), {.friction = 0.2});
  world->run(0.5);
  return world->state().v.tail<3>().norm();
}

// It is thrown without spin, and slips until it rolls.
double speedOfBowlingBall(const Engine& engine) {
  const Model model = ballOnSlope(0);
  const auto world = engine(model, {.friction = 0.2});
  State state = initialState(model);
  state.v[0] = 3;
  world->setState(state);
  world->run(1);
  return world->state().v[0];
}

// Springs pull it from both sides; it rolls, so that its spin counts as mass.
constexpr double kStiffness = 50;  // N/m, of each
double periodOnSprings(const Engine& engine) {
  const Model model = ballOnSlope(0);
  const auto world = engine(model, {.friction = 0.8});
  State state = initialState(model);
  state.q[0] = 0.05;
  world->setState(state);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(6);
  double first = -1, last = 0, before = 0.05;
  int crossings = 0;
  for (int i = 1; i <= 6000; ++i) {
    u[0] = -2 * kStiffness * before;
    world->setForces(u);
    world->step();
    const double x = world->state().q[0];
    if (x * before < 0) {
      last = (i - x / (x - before)) * kStep;
      if (first < 0) first = last;
      ++crossings;
    }
    before = x;
  }
  return 2 * (last - first) / (crossings - 1);
}

}  // namespace

std::vector<ContactScene> rollingScenes() {
  return {{.name = "roll",
           .quantity = "way of a ball that rolls down a slope in 1 s",
           .law = "5/7 g sin a t^2 / 2",
           .unit = "m",
           .formula = 5. / 7 * kGravity * std::sin(0.3) / 2,
           .reached = 3e-3,
           .measured = rollingWay,
           .model = ballOnSlope(0.3)},
          {.name = "roll-slip",
           .quantity = "spin after 0.5 s of a ball that slips on a steep slope",
           .law = "5/2 mu g cos a t / r",
           .unit = "rad/s",
           .formula = 2.5 * 0.2 * kGravity * std::cos(0.8) * 0.5 / kRadius,
           .reached = 0.02,
           .measured = spinOfSlippingBall,
           .model = ballOnSlope(0.8)},
          {.name = "bowl",
           .quantity = "speed of a ball that was thrown at 3 m/s without spin",
           .law = "5/7 v",
           .unit = "m/s",
           .formula = 15. / 7,
           .reached = 2e-3,
           .measured = speedOfBowlingBall,
           .model = ballOnSlope(0)},
          {.name = "wheel",
           .quantity = "period of a wheel on two springs",
           .law = "2 pi sqrt((m + I/r^2) / 2k)",
           .unit = "s",
           .formula = 2 * M_PI * std::sqrt(1.4 * kMass / (2 * kStiffness)),
           .reached = 2e-3,
           .measured = periodOnSprings,
           .model = ballOnSlope(0)}};
}

}  // namespace rex::contact
