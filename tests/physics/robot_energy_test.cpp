// Robots that fall onto a floor, and that are held above it by their motors: contacts give no energy back.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "dynamics/energy.h"
#include "formats/scene_file.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"
#include "support/rounds.h"

namespace rex::robot_energy_test {

namespace fs = std::filesystem;

const char* const kOurs[] = {"arm3.ors",
                             "arm7.ors",
                             "man.ors",
                             "pegArm.ors",
                             "pegArm2.ors",
                             "pegInAHole.ors",
                             "pin_balancing.ors",
                             "arm6dof/arm6dof.urdf",
                             "arm7dof/arm7dof.urdf",
                             "arm7offset/arm7offset.urdf",
                             "balancer/balancer.urdf",
                             "gripper/gripper.urdf",
                             "hand/hand.urdf",
                             "humanoid/humanoid.urdf",
                             "humanoid_hands/humanoid_hands.urdf",
                             "quadruped/quadruped.urdf"};
const char* const kOthers[] = {"urdf/Base_1.urdf",
                               "urdf/Pendulum_Tendon_1_Cart_Rail.urdf",
                               "urdf/bolt.urdf",
                               "urdf/cartpole.urdf",
                               "urdf/diff_ring.urdf",
                               "urdf/go2_description.urdf",
                               "urdf/icub_reduced.urdf",
                               "urdf/kuka_iiwa.urdf",
                               "urdf/panda_arm_hand.urdf",
                               "urdf/panda_spherized.urdf",
                               "urdf/plate.urdf",
                               "urdf/talos_left_arm.urdf",
                               "urdf/tiago.urdf",
                               "mjcf/ant.xml",
                               "mjcf/capsule_fromtoX.xml",
                               "mjcf/half_cheetah.xml",
                               "mjcf/hopper.xml",
                               "mjcf/humanoid.xml",
                               "mjcf/inverted_pendulum.xml",
                               "mjcf/walker2d.xml"};

double lowestPoint(const Model& model) {
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  double lowest = 0;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.contact || shape.body == kWorld) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    lowest = std::min(lowest, X_WS.p.z() - X_WS.R.row(2).cwiseAbs().dot(halfBounds(shape.shape)));
  }
  return lowest;
}

// 0.3 m above a floor.
Model aboveFloor(const fs::path& file, bool isFree) {
  SceneSpec spec = readScene(file, {.allowMissingMeshes = true, .freeBase = isFree}).spec;
  addGround(spec, translation(0, 0, lowestPoint(compile(spec)) - 0.3));
  return compile(spec);
}

// URDF leaves to its reader whether a robot is free. Where the root has no mass, or is the world, it is not.
std::optional<Model> placed(const fs::path& file) {
  std::string why;
  for (const bool isFree : {true, false}) {
    if (isFree && file.extension() != ".urdf") continue;
    try {
      Model model = aboveFloor(file, isFree);
      PhysicsWorld world(model);
      return model;
    } catch (const Error& error) {
      why = error.what();
    }
  }
  fmt::print("{}: cannot be simulated: {}\n", file.filename().string(), why);
  return std::nullopt;
}

std::vector<Motor> holding(const Model& model) {
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  for (const Joint& joint : model.joints()) {
    if (joint.mimics || joint.nq != joint.nv) continue;
    for (int i = 0; i < joint.nv; ++i)
      motors[static_cast<std::size_t>(joint.vIndex + i)] = {
          .kind = Motor::Kind::kPosition,
          .target = model.initialPositions()[joint.qIndex + i],
          .maxForce = std::min(joint.maxEffort, 1000.)};
  }
  return motors;
}

struct Fall {
  double lost = 0, rise = 0, above = 0, kineticAtEnd = 0;  // above: its start
};

Fall fall(const Model& model, bool isHeld) {
  PhysicsWorld world(model);
  State state = initialState(model);
  for (const Joint& joint : model.joints()) {
    if (joint.nq != joint.nv) continue;
    for (int i = joint.qIndex; i < joint.qIndex + joint.nq; ++i)
      state.q[i] = std::clamp(state.q[i], model.lowerLimits()[i], model.upperLimits()[i]);
  }
  world.setState(state);
  if (isHeld) world.setMotors(holding(model));
  const auto energyNow = [&] {
    const State now = world.state();
    return energy(model, now.q, now.v);
  };
  const double start = energyNow().total();
  double least = start;
  Fall result;
  for (int i = 0; i < 1000 * rounds(2, 5); ++i) {
    world.step(1e-3);
    const Energy now = energyNow();
    least = std::min(least, now.total());
    result.rise = std::max(result.rise, now.total() - least);
    result.above = std::max(result.above, now.total() - start);
    result.kineticAtEnd = now.kinetic;
  }
  result.lost = start - least;
  return result;
}

void expectPassive(const fs::path& file) {
  SCOPED_TRACE(file.filename().string());
  const std::optional<Model> model = placed(file);
  if (!model) return;
  const double size = model->mass() * 9.81 * 0.3;  // what a fall gives
  for (const bool isHeld : {false, true}) {
    const Fall result = fall(*model, isHeld);
    fmt::print("{} {}: lost {:.4g} J, rose by {:.3g} J, {:.3g} J kinetic at the end\n",
               file.filename().string(), isHeld ? "held" : "falling", result.lost, result.rise,
               result.kineticAtEnd);
    // Motors lift again what has sagged.
    if (isHeld) {
      EXPECT_LT(result.above, 1e-2 * size);
    } else {
      EXPECT_LT(result.rise, 0.01 * result.lost + 1e-3 * size);
    }
  }
}

TEST(RobotEnergies, OfOurs) {
  for (const char* const name : kOurs) expectPassive(sourcePath("data/robots") / name);
}

TEST(RobotEnergies, OfOthers) {
  int absent = 0;
  for (const char* const name : kOthers) {
    const fs::path file = sharedPath("data") / name;
    fs::exists(file) ? expectPassive(file) : void(++absent);
  }
  if (absent > 0) GTEST_SKIP() << absent << " files of ../shared/data are absent";
}

}  // namespace rex::robot_energy_test
