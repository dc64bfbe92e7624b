#pragma once

#include <string>
#include <vector>

#include "physics/physics_world.h"
#include "scene/scene_spec.h"

namespace rex {

/// A ball or box on a free joint, with the inertia of its volume.
inline void addLoose(SceneSpec& spec, const std::string& name, double mass, const Shape& shape,
                     const Pose& X_WB) {
  Eigen::Vector3d squares = shape.extent.cwiseAbs2() / 12;
  if (shape.type == ShapeType::kSphere) squares.setConstant(shape.radius * shape.radius / 5);
  BodySpec body;
  body.name = name;
  body.mass = mass;
  body.inertia = Eigen::Matrix3d((mass * (squares.sum() - squares.array()).matrix()).asDiagonal());
  ShapeSpec part;
  part.name = name;
  part.shape = shape;
  part.contact = true;
  body.shapes.push_back(part);
  spec.bodies.push_back(body);
  JointSpec joint;
  joint.name = name;
  joint.parent = "world";
  joint.child = name;
  joint.type = JointType::kFree;
  joint.q0 = jointCoordinates(JointType::kFree, joint.axis, X_WB);
  spec.joints.push_back(joint);
}

/// A ground of the world, its top at z = 0 of the pose.
inline void addGround(SceneSpec& spec, const Pose& X_WG = {}) {
  ShapeSpec ground;
  ground.name = "ground";
  ground.X_BS = X_WG * translation(0, 0, -0.5);
  ground.shape.extent = {100, 100, 1};
  ground.contact = true;
  spec.worldShapes.push_back(ground);
}

/// A body on a hinge of the world about y.
inline JointSpec& addHinged(SceneSpec& spec, const std::string& name, double mass, double inertia) {
  BodySpec body;
  body.name = name;
  body.mass = mass;
  body.inertia = inertia * Eigen::Matrix3d::Identity();
  spec.bodies.push_back(body);
  JointSpec joint;
  joint.name = name;
  joint.parent = "world";
  joint.child = name;
  joint.axis = Eigen::Vector3d::UnitY();
  return spec.joints.emplace_back(joint);
}

inline Shape boxShape(double x, double y, double z) {
  Shape shape;
  shape.extent = {x, y, z};
  return shape;
}

inline Shape ballShape(double radius) {
  Shape shape;
  shape.type = ShapeType::kSphere;
  shape.radius = radius;
  return shape;
}

/// The state after one step of h seconds under joint forces u, without limits and friction of joints.
inline State stepped(const Model& model, const State& state, const Eigen::VectorXd& u, double h) {
  PhysicsWorld world(model, {.jointLimits = false, .jointFriction = false});
  world.setState(state);
  std::vector<Motor> motors;
  for (const double force : u) motors.push_back({.target = force});
  world.setMotors(motors);
  world.step(h);
  return world.state();
}

}  // namespace rex
