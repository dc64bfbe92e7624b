#pragma once

#include <algorithm>
#include <string>

#include "course/simulator.h"
#include "exercise.h"
#include "scene/model.h"

// Chains of the course's robots, for pictures and checks.

inline Eigen::Matrix4d matrixOf(const rex::Pose& pose) {
  Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
  X.topLeftCorner<3, 3>() = pose.R;
  X.topRightCorner<3, 1>() = pose.p;
  return X;
}

inline rex::Pose poseOf(const Eigen::Matrix4d& X) {
  return {X.topLeftCorner<3, 3>(), X.topRightCorner<3, 1>()};
}

/// A robot's joints from the world to a body. Each is a hinge or a slider, and there is no other joint.
inline Chain chainOfRobot(const rex::Simulator& S, const std::string& name) {
  const rex::Model& model = S.model();
  Chain chain;
  rex::Pose X_JE;  // from the joint that was found last to the end
  for (rex::BodyId at = model.body(name); at != rex::kWorld;) {
    const rex::Body& body = model[at];
    if (body.joint == rex::kNoJoint) {
      X_JE = body.X_PB * X_JE;
    } else {
      const rex::Joint& joint = model[body.joint];
      const rex::Pose X_ME = joint.X_MC * X_JE;
      if (chain.joints.empty())
        chain.X_ME = matrixOf(X_ME);
      else
        chain.joints.front().X_PJ = matrixOf(X_ME);
      const bool slides = joint.type == rex::JointType::kSlider;
      chain.joints.insert(
          chain.joints.begin(),
          {Eigen::Matrix4d::Identity(), slides ? JointKind::kPrismatic : JointKind::kRevolute, joint.axis});
      X_JE = joint.X_PF;
    }
    at = body.parent;
  }
  if (!chain.joints.empty()) chain.joints.front().X_PJ = matrixOf(X_JE);
  return chain;
}
