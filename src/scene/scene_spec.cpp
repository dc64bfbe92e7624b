#include "scene/scene_spec.h"

#include <cmath>
#include <numbers>

#include "geometry/rotation.h"

namespace rex {
namespace {

// Signed angle of the part of R that turns about the unit vector a, in (-pi, pi].
double angleAbout(const Eigen::Vector3d& a, const Eigen::Matrix3d& R) {
  const Quaternion q = quaternionFromRotation(R);
  return wrapAngle(2 * std::atan2(a.dot(q.tail<3>()), q[0]));
}

Eigen::Matrix3d turnZ(double angle) { return rotationAboutAxis(angle, Eigen::Vector3d::UnitZ()); }

}  // namespace

std::string_view toString(CollisionRule rule) {
  return rule == CollisionRule::kFourGenerations ? "four_generations" : "all_but_neighbours";
}

std::string_view toString(JointType type) {
  switch (type) {
    case JointType::kRigid:
      return "rigid";
    case JointType::kHinge:
      return "hinge";
    case JointType::kSlider:
      return "slider";
    case JointType::kScrew:
      return "screw";
    case JointType::kCylindrical:
      return "cylindrical";
    case JointType::kPlanarXY:
      return "planarXY";
    case JointType::kTranslation3:
      return "translation3";
    case JointType::kPlanarXYPhi:
      return "planarXYPhi";
    case JointType::kPlanarPhiXY:
      return "planarPhiXY";
    case JointType::kUniversal:
      return "universal";
    case JointType::kBall:
      return "ball";
    case JointType::kFree:
      return "free";
  }
  return "";
}

int positionCount(JointType type) {
  switch (type) {
    case JointType::kRigid:
      return 0;
    case JointType::kHinge:
    case JointType::kSlider:
    case JointType::kScrew:
      return 1;
    case JointType::kCylindrical:
    case JointType::kPlanarXY:
    case JointType::kUniversal:
      return 2;
    case JointType::kTranslation3:
    case JointType::kPlanarXYPhi:
    case JointType::kPlanarPhiXY:
      return 3;
    case JointType::kBall:
      return 4;
    case JointType::kFree:
      return 7;
  }
  return 0;
}

int velocityCount(JointType type) {
  const bool quaternion = type == JointType::kBall || type == JointType::kFree;
  return positionCount(type) - (quaternion ? 1 : 0);
}

Pose jointMotion(JointType type, const Eigen::Vector3d& axis, double pitch, const double* q) {
  switch (type) {
    case JointType::kRigid:
      return {};
    case JointType::kHinge:
      return rotation(q[0], axis);
    case JointType::kSlider:
      return {Eigen::Matrix3d::Identity(), q[0] * axis.normalized()};
    case JointType::kScrew:
      return {rotationAboutAxis(q[0], axis), q[0] * pitch / (2 * std::numbers::pi) * axis.normalized()};
    case JointType::kCylindrical:
      return {rotationAboutAxis(q[0], axis), q[1] * axis.normalized()};
    case JointType::kPlanarXY:
      return translation(q[0], q[1], 0);
    case JointType::kTranslation3:
      return translation(q[0], q[1], q[2]);
    case JointType::kPlanarXYPhi:
      return {turnZ(q[2]), {q[0], q[1], 0}};
    case JointType::kPlanarPhiXY:
      return {turnZ(q[0]), turnZ(q[0]) * Eigen::Vector3d(q[1], q[2], 0)};
    case JointType::kUniversal:
      return rotation(q[0], Eigen::Vector3d::UnitX()) * rotation(q[1], Eigen::Vector3d::UnitY());
    case JointType::kBall:
      return {rotationFromQuaternion(Quaternion(q)), Eigen::Vector3d::Zero()};
    case JointType::kFree:
      return {rotationFromQuaternion(Quaternion(q + 3)), Eigen::Vector3d(q)};
  }
  return {};
}

Eigen::VectorXd jointCoordinates(JointType type, const Eigen::Vector3d& axis, const Pose& X_FM) {
  const Eigen::Vector3d a = axis.normalized();
  const double phi = angleAbout(Eigen::Vector3d::UnitZ(), X_FM.R);
  Eigen::VectorXd q(positionCount(type));
  switch (type) {
    case JointType::kRigid:
      break;
    case JointType::kHinge:
    case JointType::kScrew:
      q << angleAbout(a, X_FM.R);
      break;
    case JointType::kSlider:
      q << a.dot(X_FM.p);
      break;
    case JointType::kCylindrical:
      q << angleAbout(a, X_FM.R), a.dot(X_FM.p);
      break;
    case JointType::kPlanarXY:
      q << X_FM.p.head<2>();
      break;
    case JointType::kTranslation3:
      q << X_FM.p;
      break;
    case JointType::kPlanarXYPhi:
      q << X_FM.p.head<2>(), phi;
      break;
    case JointType::kPlanarPhiXY:
      q << phi, (turnZ(-phi) * X_FM.p).head<2>();
      break;
    case JointType::kUniversal:
      // Rx(a) Ry(b) has the columns (cos b, sin a sin b, -cos a sin b) and (0, cos a, sin a).
      q << std::atan2(X_FM.R(2, 1), X_FM.R(1, 1)), std::atan2(X_FM.R(0, 2), X_FM.R(0, 0));
      break;
    case JointType::kBall:
      q << quaternionFromRotation(X_FM.R);
      break;
    case JointType::kFree:
      q << X_FM.p, quaternionFromRotation(X_FM.R);
      break;
  }
  return q;
}

Eigen::VectorXd JointSpec::start() const { return q0.size() > 0 ? q0 : jointCoordinates(type, axis, Pose{}); }

}  // namespace rex
