#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "bench/physics_peer.h"
#include "bench/row.h"
#include "formats/scene_file.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

Model modelOf(const Boxes& boxes) {
  SceneSpec spec;
  addGround(spec);
  for (int row = 0; row < boxes.rows; ++row) {
    for (int column = 0; column < boxes.columns; ++column)
      addLoose(spec, fmt::format("box{}_{}", row, column), kBoxMass, boxShape(kBoxEdge, kBoxEdge, kBoxEdge),
               {.p = boxes.center(row, column)});
  }
  return compile(spec);
}

// Both must have come to lie where the last box belongs.
void requireRest(const std::string& who, double height, const Boxes& boxes) {
  if (std::abs(height - boxes.center(boxes.rows - 1, boxes.columns - 1).z()) < 5e-3) return;
  throw std::logic_error(who + " does not hold its boxes");
}

// Once they lie. Bullet by itself takes ten iterations.
Row boxesRow(const std::string& name, const Boxes& boxes, int bulletIterations, double target) {
  const auto ours = std::make_shared<PhysicsWorld>(modelOf(boxes));
  const PhysicsPeer bullet = bulletBoxes(boxes, bulletIterations);
  for (int i = 0; i < 500; ++i) {
    ours->step(kPhysicsStep);
    bullet.step();
  }
  const State state = ours->state();
  requireRest("rex", state.q[state.q.size() - 5], boxes);
  requireRest("Bullet", bullet.height(), boxes);
  return {name, timed([ours] { ours->step(kPhysicsStep); }), "Bullet", timed(bullet.step), target, "us"};
}

// With its friction, damping and limits; it falls, and begins anew after a second.
struct Arm {
  explicit Arm(const Model& model) : world(model), start(initialState(model)) {}
  void step() {
    if (steps++ % 1000 == 0) world.setState(start);
    world.step(kPhysicsStep);
  }

  PhysicsWorld world;
  State start;
  int steps = 0;
};

}  // namespace

Eigen::Vector3d Boxes::center(int row, int column) const {
  return {distance * column, distance * row, kBoxEdge / 2};
}

std::vector<Row> physicsRows() {
  const Boxes boxes;
  const auto arm =
      std::make_shared<Arm>(compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec));
  return {boxesRow("boxes-20", boxes, 10, 2.),
          {.name = "physics-arm7",
           .ours = timed([arm] { arm->step(); }),
           .peerName = "limit",
           .peer = [] { return 1.8e-6; },
           .target = 1.,
           .unit = "us"}};
}

}  // namespace rex::bench
