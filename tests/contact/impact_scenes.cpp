// Hits, loads that contacts pass on, and friction that jams.
#include <cmath>

#include "contact/contact_scenes.h"
#include "geometry/rotation.h"

namespace rex::contact {
namespace {

using Eigen::Vector3d;

Model fallingBall() {
  SceneSpec spec;
  addGround(spec);
  addLoose(spec, "ball", 1, ballShape(0.1), translation(0, 0, 1.1));
  return compile(spec);
}

double reboundHeight(const Engine& engine) {
  const auto world = engine(fallingBall(), {.restitution = 0.8});
  const double fall = std::sqrt(2 / kGravity);
  world->run(fall + 0.02);
  double highest = 0;
  for (int i = 0; i < 1000; ++i) {
    world->step();
    highest = std::max(highest, world->state().q[2] - 0.1);
  }
  return highest;
}

Model stackOf(int boxes) {
  SceneSpec spec;
  addGround(spec);
  for (int i = 0; i < boxes; ++i)
    addLoose(spec, "box" + std::to_string(i), 1, boxShape(0.2, 0.2, 0.2), translation(0, 0, 0.1 + 0.2 * i));
  return compile(spec);
}

double loadBelow(const Engine& engine) {
  const Model model = stackOf(10);
  const auto world = engine(model, {});
  world->run(2);
  return world->normalForce(shapeNamed(model, "ground"));
}

// Balls on a rail, 2 mm apart.
constexpr int kBalls = 5;
Model cradle() {
  SceneSpec spec;
  for (int i = 0; i < kBalls; ++i) {
    BodySpec body;
    body.name = "ball" + std::to_string(i);
    body.mass = 1;
    body.inertia = 4e-3 * Eigen::Matrix3d::Identity();
    ShapeSpec shape;
    shape.name = body.name;
    shape.shape = ballShape(0.1);
    shape.contact = true;
    body.shapes.push_back(shape);
    spec.bodies.push_back(body);
    JointSpec rail;
    rail.name = body.name;
    rail.parent = "world";
    rail.child = body.name;
    rail.type = JointType::kSlider;
    rail.X_PF.p = {0.202 * i, 0, 0};
    spec.joints.push_back(rail);
  }
  return compile(spec);
}

double speedOfLastBall(const Engine& engine, double restitution) {
  const Model model = cradle();
  const auto world = engine(model, {.friction = 0, .restitution = restitution});
  State state = initialState(model);
  state.v[0] = 1;
  world->setState(state);
  world->run(0.2);
  return world->state().v[kBalls - 1];
}

// A rod of a metre that slides ahead on its lower tip, which is in front of its centre, as chalk that is
// pushed. Its axis meets the ground at 60 degrees.
constexpr double kHalf = 0.5, kThin = 0.005, kRodMass = 1;
const double kSlant = M_PI / 3;
Model chalk() {
  SceneSpec spec;
  addGround(spec);
  const Vector3d back(-std::cos(kSlant), 0, std::sin(kSlant));
  Pose X_WB = rotation(-(M_PI / 2 - kSlant), Vector3d::UnitY());
  X_WB.p = kHalf * back + Vector3d(0, 0, kThin);
  addLoose(spec, "rod", kRodMass, capsuleShape(kThin, 2 * kHalf), X_WB);
  const double I = kRodMass * kHalf * kHalf / 3;
  spec.bodies.back().inertia = Vector3d(I, I, 1e-4).asDiagonal();
  return compile(spec);
}

std::unique_ptr<SceneWorld> pushedChalk(const Engine& engine, double friction, double speed) {
  const Model model = chalk();
  auto world = engine(model, {.friction = friction});
  State state = initialState(model);
  state.v[0] = speed;
  world->setState(state);
  return world;
}

// Friction turns the rod onto its tip, and so presses it more than its weight.
double forceOnChalk(const Engine& engine) {
  const auto world = pushedChalk(engine, 1, 3);
  world->run(2 * kStep);
  return world->normalForce(shapeNamed(chalk(), "rod"));
}

// Beyond a friction of 1.35 no finite force keeps the tip on the ground: it jams at once, as by a hit, though
// nothing hits (Painleve's paradox). The rod turns on about its tip with the angular momentum that it has
// about it.
double turnOfJammedChalk(const Engine& engine) {
  const auto world = pushedChalk(engine, 2.5, 2);
  world->run(2 * kStep);
  return std::abs(world->state().v[4]);
}

// A ladder without friction between wall and floor: its centre moves on a circle.
constexpr double kLean = 0.3;
Model ladder() {
  SceneSpec spec;
  addGround(spec);
  ShapeSpec wall;
  wall.name = "wall";
  wall.shape = boxShape(1, 10, 10);
  wall.X_BS = translation(-0.5, 0, 5);
  wall.contact = true;
  spec.worldShapes.push_back(wall);
  Pose X_WB = rotation(-kLean, Vector3d::UnitY());
  X_WB.p = Vector3d(kHalf * std::sin(kLean) + kThin, 0, kHalf * std::cos(kLean) + kThin);
  addLoose(spec, "ladder", kRodMass, capsuleShape(kThin, 2 * kHalf), X_WB);
  const double I = kRodMass * kHalf * kHalf / 3;
  spec.bodies.back().inertia = Vector3d(I, I, 1e-4).asDiagonal();
  return compile(spec);
}

// The share of its height at which the ladder leaves the wall.
double heightAtDeparture(const Engine& engine) {
  const Model model = ladder();
  const auto world = engine(model, {.friction = 0});
  const int wall = shapeNamed(model, "wall");
  double height = 1;
  for (int i = 0; i < 1000; ++i) {
    world->step();
    const double z = (world->state().q[2] - kThin) / (kHalf * std::cos(kLean));
    if (world->normalForce(wall) > 1e-3) height = z;
    if (z < 0.4) break;
  }
  return height;
}

}  // namespace

std::vector<ContactScene> impactScenes() {
  const double c = std::cos(kSlant), s = std::sin(kSlant) + kThin / kHalf;  // where its rounded tip touches
  return {{.name = "rebound",
           .quantity = "height after a fall of 1 m with a restitution of 0.8",
           .law = "e^2 h",
           .unit = "m",
           .formula = 0.64,
           .reached = 0.01,
           .measured = reboundHeight,
           .model = fallingBall(),
           .bounces = true},
          {.name = "stack",
           .quantity = "load below ten boxes of 1 kg",
           .law = "10 m g",
           .unit = "N",
           .formula = 10 * kGravity,
           .reached = 0.01,
           .measured = loadBelow,
           .model = stackOf(10)},
          {.name = "cradle",
           .quantity = "speed of the last of five balls, hit at 1 m/s, elastic",
           .law = "v",
           .unit = "m/s",
           .formula = 1,
           .reached = 1e-6,
           .measured = [](const Engine& engine) { return speedOfLastBall(engine, 1); },
           .model = cradle(),
           .bounces = true},
          {.name = "cradle-inelastic",
           .quantity = "the same if nothing bounces",
           .law = "v / 5",
           .unit = "m/s",
           .formula = 0.2,
           .reached = 1e-3,
           .measured = [](const Engine& engine) { return speedOfLastBall(engine, 0); },
           .model = cradle(),
           .needsRigidity = true},
          {.name = "chalk",
           .quantity = "force on the tip of a rod that is pushed ahead, mu = 1",
           .law = "m g / (1 + 3 cos^2 a - 3 mu sin a cos a)",
           .unit = "N",
           .formula = kRodMass * kGravity / (1 + 3 * c * c - 3 * s * c),
           .reached = 0.1,
           .measured = forceOnChalk,
           .model = chalk(),
           .needsRigidity = true},
          {.name = "painleve",
           .quantity = "spin of the same rod at 2 m/s once it has jammed, mu = 2.5",
           .law = "m v l sin a / I, about the tip",
           .unit = "rad/s",
           .formula = 2 * s / (kHalf * (1. / 3 + c * c + s * s)),
           .reached = 0.02,
           .measured = turnOfJammedChalk,
           .model = chalk(),
           .needsRigidity = true},
          {.name = "ladder",
           .quantity = "share of its height at which a ladder leaves the wall",
           .law = "2/3",
           .unit = "1",
           .formula = 2. / 3,
           .reached = 5e-3,
           .measured = heightAtDeparture,
           .model = ladder()}};
}

}  // namespace rex::contact
