// The balancer of the robots stands as long as its wheels hold it, and falls otherwise.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"

namespace rex::balancer_test {

// On its wheels, which are 0.1 m high, and leaning forward.
Model balancer(double lean) {
  SceneSpec spec = readScene(sourcePath("data/robots/balancer/balancer.urdf")).spec;
  addGround(spec);
  JointSpec root;
  root.name = "root";
  root.parent = "world";
  root.child = "chassis";
  root.type = JointType::kFree;
  root.q0 = jointCoordinates(JointType::kFree, root.axis,
                             translation(0, 0, 0.1) * rotation(lean, Eigen::Vector3d::UnitY()));
  spec.joints.push_back(root);
  return compile(spec);
}

double leanOf(const Model& model, const State& state) {
  const Pose X_WB = forwardKinematics(model, state.q)[model.body("chassis")];
  return std::atan2(X_WB.R(0, 2), X_WB.R(2, 2));
}

class Balancer : public testing::Test {
 protected:
  const Joint& joint(const std::string& name) const {
    return *std::find_if(model_.joints().begin(), model_.joints().end(),
                         [&](const Joint& one) { return one.name == name; });
  }

  // Leaning and driving, each with its rate, act back on the wheels: a controller with four numbers.
  void hold(PhysicsWorld& world) const {
    const State state = world.state();
    const Joint& root = joint("root");
    const double x = state.q[root.qIndex], speed = state.v[root.vIndex], turning = state.v[root.vIndex + 4];
    const double torque = 20 * leanOf(model_, state) + 4 * turning + 3 * x + 5 * speed;
    std::vector<Motor> motors(static_cast<std::size_t>(model_.nv()));
    for (const char* wheel : {"left_wheel_drive", "right_wheel_drive"})
      motors[static_cast<std::size_t>(joint(wheel).vIndex)].target = torque / 2;
    world.setMotors(motors);
  }

  Model model_ = balancer(0.1);
};

TEST_F(Balancer, StandsIfItsWheelsHoldIt) {
  PhysicsWorld world(model_);
  double worst = 0;
  for (int i = 0; i < 10'000; ++i) {
    hold(world);
    world.step(1e-3);
    worst = std::max(worst, std::abs(leanOf(model_, world.state())));
  }
  EXPECT_LT(worst, 0.25);
  EXPECT_LT(std::abs(leanOf(model_, world.state())), 0.01);
  EXPECT_LT(world.state().q.segment<2>(joint("root").qIndex).norm(), 0.05);
  EXPECT_LT(world.state().v.norm(), 0.05);
}

TEST_F(Balancer, FallsForwardOtherwise) {
  PhysicsWorld world(model_);
  world.step(3);
  EXPECT_GT(leanOf(model_, world.state()), 1.2);
  EXPECT_LT(world.state().v.norm(), 0.5);
}

}  // namespace rex::balancer_test
