// Blocks on dry friction: Coulomb's law, and tipping before slipping.
#include <cmath>

#include "contact/contact_scenes.h"
#include "geometry/rotation.h"

namespace rex::contact {
namespace {

using Eigen::Vector3d;

const Shape kBlock = boxShape(0.4, 0.4, 0.2), kTower = boxShape(0.2, 0.2, 0.4);

Model onSlope(const Shape& block, double angle) {
  const Pose X_WG = rotation(angle, Vector3d::UnitY());
  SceneSpec spec;
  addGround(spec, X_WG);
  addLoose(spec, "block", 2, block, X_WG * translation(0, 0, block.extent.z() / 2));
  return compile(spec);
}

// How far a block that starts at rest is after so many seconds.
double wayOnSlope(const Engine& engine, double angle, double friction, double seconds) {
  const Model model = onSlope(kBlock, angle);
  const auto world = engine(model, {.friction = friction});
  world->run(seconds);
  return (world->state().q - model.initialPositions()).head<3>().norm();
}

double turnOnSlope(const Engine& engine, double angle) {
  const Model model = onSlope(kTower, angle);
  const auto world = engine(model, {.friction = 2});
  world->run(1);
  const Eigen::Vector4d q0 = model.initialPositions().segment<4>(3), q = world->state().q.segment<4>(3);
  return 2 * std::acos(std::min(1.0, std::abs(q0.dot(q))));
}

// How far a block gets that is pushed off at 2 m/s in this direction.
double slidingDistance(const Engine& engine, double direction) {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "block", 2, kBlock, translation(0, 0, 0.1));
  const Model model = compile(spec);
  const auto world = engine(model, {.friction = 0.4});
  State state = initialState(model);
  state.v.head<2>() << 2 * std::cos(direction), 2 * std::sin(direction);
  world->setState(state);
  world->run(1);
  return world->state().q.head<2>().norm();
}

// A block that spins about the vertical rubs with its four corners.
double spinDeceleration(const Engine& engine) {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "block", 2, boxShape(0.2, 0.2, 0.1), translation(0, 0, 0.05));
  const Model model = compile(spec);
  const auto world = engine(model, {.friction = 0.3});
  State state = initialState(model);
  state.v[5] = 20;
  world->setState(state);
  world->run(0.2);
  return (20 - world->state().v[5]) / 0.2;
}

}  // namespace

std::vector<ContactScene> slidingScenes() {
  const double critical = std::atan(0.5);
  return {
      {.name = "stick",
       .quantity = "steepest slope on which a block stays",
       .law = "atan mu",
       .unit = "rad",
       .formula = critical,
       .reached = 1e-3,
       .measured =
           [=](const Engine& engine) {
             return turningPoint(critical - 0.05, critical + 0.05, 1e-4,
                                 [&](double angle) { return wayOnSlope(engine, angle, 0.5, 0.3) > 3e-4; });
           },
       .model = onSlope(kBlock, critical - 0.01),
       .needsRigidity = true},
      {.name = "slip",
       .quantity = "way of a block down a slope in 1 s",
       .law = "g (sin a - mu cos a) t^2 / 2",
       .unit = "m",
       .formula = kGravity * (std::sin(critical) - 0.3 * std::cos(critical)) / 2,
       .reached = 3e-3,
       .measured = [=](const Engine& engine) { return wayOnSlope(engine, critical, 0.3, 1); },
       .model = onSlope(kBlock, critical)},
      {.name = "tip",
       .quantity = "steepest slope on which a tower stands",
       .law = "atan(width / height)",
       .unit = "rad",
       .formula = critical,
       .reached = 1e-3,
       .measured =
           [=](const Engine& engine) {
             return turningPoint(critical - 0.05, critical + 0.05, 1e-4,
                                 [&](double angle) { return turnOnSlope(engine, angle) > 0.05; });
           },
       .model = onSlope(kTower, critical - 0.01)},
      {.name = "slide",
       .quantity = "sliding distance from 2 m/s",
       .law = "v^2 / (2 mu g)",
       .unit = "m",
       .formula = 4 / (2 * 0.4 * kGravity),
       .reached = 2e-3,
       .measured = [](const Engine& engine) { return slidingDistance(engine, 0); },
       .model = onSlope(kBlock, 0)},
      {.name = "cone",
       .quantity = "the same between two axes: 0.72 with a pyramid",
       .law = "v^2 / (2 mu g)",
       .unit = "m",
       .formula = 4 / (2 * 0.4 * kGravity),
       .reached = 2e-3,
       .measured = [](const Engine& engine) { return slidingDistance(engine, M_PI / 4); },
       .model = onSlope(kBlock, 0),
       .needsRigidity = true},
      {.name = "spin",
       .quantity = "deceleration of a block that spins on its corners",
       .law = "mu m g r / I",
       .unit = "rad/s^2",
       .formula = 0.3 * kGravity * 0.1 * std::sqrt(2) / ((0.04 + 0.04) / 12),
       .reached = 0.7,
       .measured = spinDeceleration,
       .model = onSlope(boxShape(0.2, 0.2, 0.1), 0)},
  };
}

}  // namespace rex::contact
