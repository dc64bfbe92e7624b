#include "support/urdfdom_robot.h"

#include <stdexcept>

#include <urdf_parser/urdf_parser.h>

#include "support/kdl_tree.h"

namespace rex {
namespace {

KDL::Frame frameOf(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {KDL::Rotation::Quaternion(r.x, r.y, r.z, r.w),
          KDL::Vector(pose.position.x, pose.position.y, pose.position.z)};
}

KDL::Joint jointOf(const urdf::Joint& joint) {
  const KDL::Frame frame = frameOf(joint.parent_to_joint_origin_transform);
  const KDL::Vector axis = frame.M * KDL::Vector(joint.axis.x, joint.axis.y, joint.axis.z);
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return {joint.name, frame.p, axis, KDL::Joint::RotAxis};
    case urdf::Joint::PRISMATIC:
      return {joint.name, frame.p, axis, KDL::Joint::TransAxis};
    case urdf::Joint::FIXED:
      return KDL::Joint(joint.name, KDL::Joint::Fixed);
    case urdf::Joint::UNKNOWN:
    case urdf::Joint::FLOATING:
    case urdf::Joint::PLANAR:
      break;
  }
  throw std::runtime_error("joint '" + joint.name + "' is of a type that KDL lacks");
}

void addLink(const urdf::Link& link, UrdfdomRobot& robot) {
  if (link.inertial) {
    const urdf::Inertial& i = *link.inertial;
    UrdfdomRobot::Inertial& own = robot.inertials[link.name];
    own.mass = i.mass;
    own.X_BI = poseFrom(frameOf(i.origin));
    own.I << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
  }
  for (const urdf::LinkSharedPtr& child : link.child_links) {
    const urdf::Joint& joint = *child->parent_joint;
    robot.tree.addSegment(
        KDL::Segment(child->name, jointOf(joint), frameOf(joint.parent_to_joint_origin_transform)),
        link.name);
    UrdfdomRobot::Follow& follow = robot.joints[joint.name];
    follow.target = joint.name;
    if (joint.mimic) follow = {joint.mimic->joint_name, joint.mimic->multiplier, joint.mimic->offset};
    addLink(*child, robot);
  }
}

}  // namespace

UrdfdomRobot urdfdomRobot(const std::string& text) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model) throw std::runtime_error("urdfdom refuses this robot");
  UrdfdomRobot robot;
  robot.root = model->getRoot()->name;
  robot.tree = KDL::Tree(robot.root);
  addLink(*model->getRoot(), robot);
  return robot;
}

}  // namespace rex
