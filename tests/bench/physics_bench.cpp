#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/physics_peer.h"
#include "bench/row.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "scene/scene_file.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

Model boxes() {
  SceneSpec spec;
  addGround(spec);
  for (int i = 0; i < kBoxes; ++i) {
    addLoose(spec, "box" + std::to_string(i), kBoxMass, boxShape(kBoxEdge, kBoxEdge, kBoxEdge),
             translation(kBoxDistance * (i % 5), kBoxDistance * (i / 5), kBoxEdge / 2));
  }
  return compile(spec);
}

// Both must have come to lie where the boxes touch the plane.
void requireRest(const std::string& who, double height) {
  if (std::abs(height - kBoxEdge / 2) < 1e-3) return;
  throw std::logic_error(who + " does not hold its boxes");
}

}  // namespace

std::vector<Row> physicsRows() {
  const PhysicsOptions options;
  const auto ours = std::make_shared<PhysicsWorld>(boxes(), options);
  const PhysicsPeer bullet = bulletBoxes(options.iterations);
  for (int i = 0; i < 500; ++i) {
    ours->step(kPhysicsStep);
    bullet.step();
  }
  const State state = ours->state();
  requireRest("rex", state.q[state.q.size() - 5]);
  requireRest("Bullet", bullet.height());
  const auto arm =
      std::make_shared<PhysicsWorld>(compile(readScene(sourcePath("data/robots/arm7dof/arm7dof.urdf")).spec));
  return {{"boxes-20", timed([ours] { ours->step(kPhysicsStep); }), "Bullet", timed(bullet.step), 1 / 0.9},
          {"physics-arm7", timed([arm] { arm->step(kPhysicsStep); })}};
}

}  // namespace rex::bench
