#include <gtest/gtest.h>

#include "control/operational_contacts.h"
#include "course/simulator.h"
#include "kinematics/task_maps.h"
#include "physics/physics_world.h"

namespace rex::pressing_test {

// An arm comes down on a table without friction and wipes it in circles. What it presses with is measured by
// another program, the physics engine.
TEST(ForcesInContact, AreMeasuredByThePhysicsEngine) {
  Simulator scene("arm7");
  scene.addObstacle({.type = ShapeType::kBox, .extent = {1.2, 1.2, 0.1}}, translation(0, -1.6, 0.95),
                    "table");
  const Model& model = scene.model();
  const TaskMap tip = positionTask(model.body("arm7"), {0, 0, 0.2}), place = taskRows(tip, 0, 2),
                height = taskRows(tip, 2, 1);
  State now = initialState(model);
  now.q << -0.3, 0.6, 0.9, 0.5, 0.7, 0.3, 0.2;
  const Eigen::VectorXd posture = now.q;
  PhysicsWorld world(model, {.friction = 0});
  world.setState(now);
  int touching = 0;
  for (; now.time < 6; now = world.state()) {
    const double phase = 1.5 * now.time;
    const Eigen::Vector2d ahead(std::cos(phase), std::sin(phase)), aside(-ahead.y(), ahead.x());
    const OperationalTask along{.task = {.map = place, .target = Eigen::Vector2d(0, -1.6) + 0.25 * ahead},
                                .gains = pdGains(1, 0.15, 1),
                                .velocity = 0.375 * aside},
        down{.task = {.map = height, .target = Eigen::VectorXd::Constant(1, 1.08)},
             .gains = pdGains(1, 0.4, 1)},
        rest{.task = {.map = homingTask(posture)}, .gains = pdGains(1, 0.6, 1)};
    const double wanted = now.time < 5 ? 20 : 45;
    const OperationalContact table{.map = height, .force = Eigen::VectorXd::Constant(1, wanted)};
    const bool touches = !world.contacts().empty();
    const Eigen::VectorXd u =
        touches ? forcesInContact(model, now, {&table, 1}, std::vector{along, rest}, {.damping = 0.1})
                : prioritisedForces(model, now, std::vector{along, down, rest}, {.damping = 0.1});
    std::vector<Motor> motors(7);
    for (int k = 0; k < 7; ++k) motors[k].target = u[k];
    world.setMotors(motors);
    world.step(1e-3);
    touching = touches ? touching + 1 : 0;
    const bool changes = now.time > 4.99 && now.time < 5.1;  // to another force
    if (touching < 100 || changes) continue;                 // or comes to rest on the table
    double pressed = 0;
    for (const PhysicsContact& one : world.contacts()) pressed += one.impulse / 1e-3;
    ASSERT_NEAR(pressed, wanted, 0.01 * wanted) << now.time << " s";
  }
  EXPECT_GT(touching, 2000);
}

}  // namespace rex::pressing_test
