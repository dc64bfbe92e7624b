// A gripper of four-bars, as makers publish them: two drivers that a coupling joins, fingers that pins guide,
// and motors on all joints. The motors, the coupling and the pins are solved together.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/energy.h"
#include "formats/mjcf_reader.h"
#include "kinematics/closed_loops.h"
#include "physics/physics_world.h"

namespace rex::held_loops_test {

using Eigen::VectorXd;

std::string side(const std::string& name, const std::string& y, const std::string& axis,
                 const std::string& tipRange) {
  const auto at = [&](const std::string& offset, const std::string& z) {
    return " pos='0 " + y + offset + " " + z + "'";
  };
  const std::string way = " axis='" + axis + " 0 0'/>";
  return "<body name='" + name + "_knuckle'" + at("0.035", "0.0591") + "><joint name='" + name +
         "_drive' range='0 0.85'" + way + "<inertial pos='0 " + y +
         "0.0216 0.0011' mass='0.0336' diaginertia='1.9e-5 1.8e-5 4.7e-6'/><body name='" + name + "_finger'" +
         at("0.03546", "0.04204") + "><joint name='" + name + "_tip' range='" + tipRange + "'" +
         (" axis='" + std::string(axis == "1" ? "-1" : "1") + " 0 0'/>") + "<inertial pos='0 " + y +
         "0.0164 0.0258' mass='0.0483' diaginertia='1.8e-5 1.7e-5 4.6e-6'/></body></body><body name='" +
         name + "_inner'" + at("0.02", "0.0741") + "><joint name='" + name + "_guide' range='0 0.85'" + way +
         "<inertial pos='0 " + y + "0.0218 0.025' mass='0.023' diaginertia='8.4e-6 7.4e-6 2.1e-6'/></body>";
}

// On an arm that swings.
Model gripper(const std::string& tipRange = "-2 2") {
  return compile(
      parseMjcf(
          "<mujoco><compiler angle='radian'/><worldbody><body name='arm' pos='0 0 1'>"
          "<joint name='arm' axis='0 1 0'/><inertial pos='0 0 -.1' mass='.7' diaginertia='.01 .01 .001'/>"
          "<body name='hand' pos='0 0 -.2' euler='3.14159 0 0'>" +
              side("left", "", "-1", tipRange) + side("right", "-", "1", tipRange) +
              "</body></body></worldbody><equality>"
              "<connect body1='left_finger' body2='left_inner' anchor='0 0.015 0.015'/>"
              "<connect body1='right_finger' body2='right_inner' anchor='0 -0.015 0.015'/>"
              "<joint joint1='left_drive' joint2='right_drive'/></equality></mujoco>",
          "g.xml")
          .spec);
}

double gap(const Model& model, const VectorXd& q) {
  return stackLoops(model, pinTasks(model), q).y.lpNorm<Eigen::Infinity>();
}

int indexOf(const Model& model, const char* joint) {
  return std::ranges::find(model.joints(), joint, &Joint::name)->vIndex;
}

// The arm raised, and the drivers turned by 0.4 rad.
VectorXd opened(const Model& model) {
  VectorXd q = model.initialPositions();
  const int driven[] = {indexOf(model, "arm"), indexOf(model, "right_drive")};
  q[driven[0]] = 0.8, q[driven[1]] = 0.4;
  const ClosedPosture posture = assemble(model, pinTasks(model), q, driven);
  EXPECT_EQ(posture.status, ClosedPosture::Status::kClosed);
  return posture.q;
}

struct Held {
  double gained = 0, moved = 0, apart = 0, fastest = 0;
};

Held hold(const Model& model, double seconds, double maxForce) {
  PhysicsWorld world(model);
  const VectorXd start = opened(model), none = VectorXd::Zero(model.nv());
  world.setState({start, none});
  std::vector<Motor> motors;
  for (const double q : start) motors.push_back({Motor::Kind::kPosition, q, maxForce});
  world.setMotors(motors);
  const double before = energy(model, start, none).total();
  Held held;
  for (int i = 0; i < 1000 * seconds; ++i) {
    world.step(1e-3);
    const State now = world.state();
    held.gained = std::max(held.gained, energy(model, now.q, now.v).total() - before);
    held.moved = std::max(held.moved, (now.q - start).lpNorm<Eigen::Infinity>());
    held.apart = std::max(held.apart, gap(model, now.q));
    held.fastest = std::max(held.fastest, now.v.lpNorm<Eigen::Infinity>());
  }
  return held;
}

TEST(HeldLoops, StandStill) {
  const Held held = hold(gripper(), 5, 50);
  EXPECT_LT(held.gained, 1e-9);
  EXPECT_LT(held.moved, 1e-9);
  EXPECT_LT(held.fastest, 1e-6);
  EXPECT_LT(held.apart, 1e-12);
}

// Limits of the fingers close the gripper against its motors. As rows of their own beside motors and limits,
// pins and coupling let it explode after 0.9 s, at 1576 rad/s.
TEST(HeldLoops, YieldToTheirLimits) {
  const Held held = hold(gripper("0 0.85"), 5, 50);
  EXPECT_LT(held.gained, 0.01) << "J";
  EXPECT_LT(held.fastest, 2) << "rad/s";
  EXPECT_GT(held.moved, 0.1);
  EXPECT_LT(held.apart, 1e-6);
}

// The drivers alone hold the fingers, and the arm falls: nothing gains energy.
TEST(HeldLoops, AreHeldByTheirDrivers) {
  const Model model = gripper();
  PhysicsWorld world(model);
  const State start{opened(model), VectorXd::Zero(model.nv())};
  world.setState(start);
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  const int driver = indexOf(model, "right_drive");
  motors[static_cast<std::size_t>(driver)] = {Motor::Kind::kPosition, start.q[driver], 5};
  world.setMotors(motors);
  const double before = energy(model, start.q, start.v).total();
  double most = before, moved = 0, swung = 0;
  for (int i = 0; i < 5000; ++i) {
    world.step(1e-3);
    const State now = world.state();
    most = std::max(most, energy(model, now.q, now.v).total());
    swung = std::max(swung, start.q[0] - now.q[0]);
    for (const char* name : {"right_drive", "left_tip", "right_tip", "left_guide", "right_guide"})
      moved = std::max(moved, std::abs(now.q[indexOf(model, name)] - start.q[indexOf(model, name)]));
  }
  EXPECT_LT(most - before, 0.01);
  EXPECT_LT(moved, 1e-3);
  EXPECT_GT(swung, 1.5);
}

TEST(HeldLoops, SinkWhereMotorsAreTooWeak) { EXPECT_GT(hold(gripper(), 1, 1e-4).moved, 0.05); }

}  // namespace rex::held_loops_test
