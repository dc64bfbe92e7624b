#pragma once

#include "formats/scene_file.h"
#include "grasping/object_surface.h"
#include "kinematics/forward_kinematics.h"
#include "physics/physics_world.h"
#include "physics/small_scenes.h"
#include "support/paths.h"

/// The hand of the robots closes on an object, in a simulation that knows nothing of grasps.
namespace rex::closing_hand {

inline constexpr double kMass = 0.1;      // kg
inline constexpr double kStrength = 0.1;  // N m of the last joint of a finger; more of those before

/// The hand on the world, its fingers along z, and an object before its palm, where the fingers do not push
/// it out before they are around it: a ball higher than a box.
inline Model handAnd(const Shape& object) {
  SceneSpec spec = readScene(sourcePath("data/robots/hand/hand.urdf")).spec;
  for (JointSpec& joint : spec.joints) {  // the simulation has no joints that mimic others
    joint.mimic.clear();
    joint.mimicRatio = 1;
  }
  const double fromPalm = 0.017 + halfBounds(object).x();  // a millimetre of air
  addLoose(spec, "object", kMass, object,
           translation(fromPalm, 0, object.type == ShapeType::kSphere ? 0.09 : 0.08));
  return compile(spec);
}

/// Bends all fingers until something stops them.
inline std::vector<Motor> closing(const Model& model) {
  std::vector<Motor> motors(static_cast<std::size_t>(model.nv()));
  const auto holds = [](const std::string& name, const char* part) {
    return name.find(part) != std::string::npos;
  };
  for (const Joint& joint : model.joints()) {
    if (joint.nv != 1) continue;
    Motor& motor = motors[static_cast<std::size_t>(joint.vIndex)];
    motor = {.kind = Motor::Kind::kPosition, .target = 0, .maxForce = 1};
    for (const auto& [part, share] : {std::pair{"knuckle", 3}, {"middle_bend", 2}, {"distal_bend", 1}})
      if (holds(joint.name, part))
        motor = {.kind = Motor::Kind::kVelocity, .target = 1, .maxForce = share * kStrength};
  }
  return motors;
}

inline PhysicsWorld worldOf(const Model& model, const State& state, const Eigen::Vector3d& gravity_W) {
  PhysicsWorld world(model, {.gravity_W = gravity_W});
  world.setState(state);
  world.setMotors(closing(model));
  return world;
}

inline Pose objectPose(const Model& model, const State& state) {
  return forwardKinematics(model, state.q)[model.body("object")];
}

/// Where the hand presses on the object, in the object's frame.
inline std::vector<Contact> contactsOf(const Model& model, const PhysicsWorld& world) {
  const BodyId object = model.body("object");
  const Pose X_OW = objectPose(model, world.state()).inverse();
  const auto bodyOf = [&](int shape) { return model.shapes()[static_cast<std::size_t>(shape)].body; };
  std::vector<Contact> contacts;
  for (const PhysicsContact& touch : world.contacts()) {
    const bool isA = bodyOf(touch.shapeA) == object;
    if (touch.impulse <= 0 || isA == (bodyOf(touch.shapeB) == object)) continue;
    const Eigen::Vector3d inward_W = isA ? touch.normal_W : Eigen::Vector3d(-touch.normal_W);
    contacts.push_back({X_OW * (isA ? touch.p_WA : touch.p_WB), (X_OW.R * inward_W).normalized(),
                        PhysicsOptions{}.friction});
  }
  return contacts;
}

}  // namespace rex::closing_hand
